// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The sheets through which seeds may let edges pass (leaks.hpp): what lies about a place of one.

#include <cstdint>
#include <span>
#include <vector>

#include "tess/barrier/query/protection_zone.hpp"
#include "tess/barrier/seeds/leak_probes.hpp"
#include "tess/barrier_query.hpp"
#include "tess/base/poll.hpp"
#include "tess/base/triangle_grid.hpp"

namespace terratet {

/// Of the protection radius: just out of the zone.
inline constexpr double just_beyond = 1 + 1e-5;

/// In protection radii: how far apart two planes may be that count as one.
inline constexpr double same_height = 0.1;

struct SheetPlane {
    Vec3 base;
    Vec3 normal;
    double protection = 0;  ///< of its fault
};

/// Neither there nor too many?
bool is_wanted(const SheetPlane& plane, const std::vector<SheetPlane>& planes);

class LeakSheets {
  public:
    /// \pre The barriers outlive this.
    explicit LeakSheets(std::span<const Barrier> barriers);

    [[nodiscard]] const BarrierQuery& query() const { return query_; }
    [[nodiscard]] double widest_protection() const { return widest_protection_; }

    /// No other sheet is near, no rim, and no bend.
    [[nodiscard]] bool is_plain(std::uint32_t barrier, const Vec3& place, const Vec3& normal) const;

    /// Of the triangles near the middle of a pair of seeds; the first is the one that it is mirrored in.
    [[nodiscard]] std::vector<SheetPlane> planes_about(std::uint32_t owner, const Vec3& base, const Vec3& normal) const;

    /// Places where seeds' planes may not tell; of those that stand close together over one sheet, one.
    [[nodiscard]] LeakProbes probes(const ProtectionZone& zone, const Box3& hull, const Poll& poll) const;

    [[nodiscard]] bool crosses(std::uint32_t barrier, const Vec3& a, const Vec3& b) const;

    /// Does any part the two?
    [[nodiscard]] bool hide(const Vec3& a, const Vec3& b) const;

    /// To the nearest sheet but that barrier's; `most` at most.
    [[nodiscard]] double distance_to_others(std::uint32_t barrier, const Vec3& p, double most) const;

    /// Where the way from a to b first meets the sheet. \pre It does.
    [[nodiscard]] Vec3 crossing_place(std::uint32_t barrier, const Vec3& a, const Vec3& b) const;

    /// \pre The place is on its sheet.
    [[nodiscard]] Vec3 normal_at(std::uint32_t barrier, const Vec3& place) const;

  private:
    std::span<const Barrier> barriers_;
    BarrierQuery query_;
    double widest_protection_ = 0;
    std::vector<Box3> boxes_;                ///< of the sheets
    TriangleGrid grid_;                      ///< of the sheets
    std::vector<std::uint32_t> barrier_of_;  ///< of each triangle there
    std::vector<char> at_rim_;               ///< by triangle
    std::vector<Vec3> normals_;              ///< by triangle
};

}  // namespace terratet
