// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What a site sees around itself, as far out as the directions need to be determined: ring by ring of natural
/// neighbours, at least two rings or 64 sites, on until their spread (the root of the sum of squares) along each axis
/// is at least a thirtieth of that along the widest; where the rings end, up to four more in each octant, wherever they
/// are. What it sees past a barrier's end, on the other side of the barrier, counts only where the rest does not do.
///
/// No site waits for directions that sites farther out cannot determine: where all sites lie on a plane or a line, or
/// nearly so at the distance that the rings have come to. And none asks for more than some 1000 in rings and about 1000
/// by distance, whatever stands around it.

#include <Eigen/Eigenvalues>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "interp/base/stamped.hpp"
#include "interp/sites/sheet_sides.hpp"
#include "interp/sites/site_mesh.hpp"
#include "interp/sites/stars.hpp"

namespace terratet {

struct Seen {
    std::int32_t vertex;
    Eigen::Vector3d offset;
    double weight;  ///< openness over distance
};

/// The axes along which the sites that are seen spread, narrowest first.
class Spread {
  public:
    explicit Spread(std::span<const Seen> seen) : Spread(moments(seen)) {}
    explicit Spread(const Eigen::Matrix3d& moments);

    [[nodiscard]] bool determines(int axis) const { return square(axis) > 0 && square(axis) >= least_; }
    [[nodiscard]] bool determines_all() const { return determines(0); }
    [[nodiscard]] Eigen::Vector3d axis(int i) const { return axes_.eigenvectors().col(i); }
    [[nodiscard]] double square(int axis) const { return axes_.eigenvalues()[axis]; }

    static Eigen::Matrix3d moments(std::span<const Seen> seen);

  private:
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes_;
    double least_;
};

/// For one site, used once.
class Surroundings {
  public:
    Surroundings(const SiteMesh& sites, const SheetSides& sides, const Stars& stars, std::int32_t site);

    const std::vector<Seen>& look();
    /// How many sites it was asked of whether they are seen.
    [[nodiscard]] std::size_t asked() const { return asked_; }
    /// Within that squared distance lies all that decided what was seen; infinity where the sites as a whole did, or
    /// nearly so.
    [[nodiscard]] double squared_reach() const { return squared_reach_; }

  private:
    void look_farther();
    bool look_at_ring(std::size_t ring);
    bool next_ring();
    [[nodiscard]] bool enough();
    [[nodiscard]] bool nothing_left(Eigen::Matrix3d moments);
    bool ask(std::int32_t vertex);
    void take_across();
    [[nodiscard]] const Vec3& point(std::int32_t v) const { return points_[static_cast<std::size_t>(v)]; }

    const SiteMesh& sites_;
    const SheetSides& sides_;
    const Stars& stars_;
    std::span<const Vec3> points_;
    std::int32_t site_;
    static thread_local StampedSet number_;
    std::size_t asked_ = 0;
    double squared_reach_ = 0;
    double reached_ = 0;  ///< squared distance of the last ring's nearest
    std::vector<std::int32_t> ring_;
    std::vector<std::pair<double, std::int32_t>> next_;
    std::vector<double> sheet_distances_;
    std::vector<Seen> seen_;
    std::vector<Seen> across_;  ///< past a barrier's end
};

}  // namespace terratet
