// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Values in cells that reach across a fault: a place takes them from vertices on its own side (DESIGN §4.4).

#include <array>
#include <cstdint>
#include <span>

#include "tess/fault_proximity.hpp"
#include "tess/tessellation.hpp"

namespace terratet {

/// A place's value is the sum of these vertices', weighted.
struct VertexWeights {
    std::array<std::uint32_t, 4> vertices{};
    std::array<double, 4> weights{};  ///< not negative, their sum is 1; all NaN: no vertex on the own side is near
};

class OwnSide {
  public:
    /// `gap` is CellTable::fault of the mesh. \pre All outlive this.
    OwnSide(const TetMesh& mesh, std::span<const std::int32_t> gap, const FaultProximity& faults)
        : mesh_(mesh), gap_(gap), faults_(faults) {}

    /// Is it a gap cell, one where faults meet included?
    [[nodiscard]] bool concerns(std::uint32_t cell) const { return gap_[cell] >= 0; }

    /// The barycentric weights of a place in a cell, those of corners that it does not see left out and the others
    /// brought to the sum 1. On a fault itself it is that of the nearest corner. Where it sees none otherwise, the
    /// nearest one it sees of the cells around. Sight is blocked by faults, by exact predicates; not by horizons and
    /// other surfaces that bar nothing. Safe from many threads.
    [[nodiscard]] VertexWeights weights(std::uint32_t cell, const Vec3& p, std::array<double, 4> barycentric) const;

  private:
    [[nodiscard]] VertexWeights nearest_seen_around(std::uint32_t cell, const Vec3& p) const;

    const TetMesh& mesh_;
    std::span<const std::int32_t> gap_;
    const FaultProximity& faults_;
};

}  // namespace terratet
