// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Values in cells that reach across a fault: a place takes them from vertices on its own side (DESIGN §4.4).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tess/barrier_query.hpp"
#include "tess/tessellation.hpp"

namespace terratet {

/// A place's value is the sum of these vertices', weighted.
struct VertexWeights {
    std::array<std::uint32_t, 4> vertices{};
    std::array<double, 4> weights{};  ///< not negative, their sum is 1; all NaN: no vertex on the own side is near
};

/// What weights make of the vertices' values: their mean, or of classes the one of the largest weight, of equal ones
/// the smaller. A value without weight does not matter. NaN for NaN weights.
double mixed(const std::array<double, 4>& weights, const std::array<double, 4>& values, bool categorical);

/// Does a barrier part the two ends of an edge? An end that lies on one, as a collapsed fault's nodes do, is beside it.
bool are_parted(const BarrierQuery& barriers, const Vec3& a, const Vec3& b);

class OwnSide {
  public:
    /// `gap` is CellTable::fault of the mesh. Beyond the extent, where no seeds keep the sides apart, any cell may
    /// reach across a barrier: each that reaches beyond is looked at; none if no extent is given. \pre All outlive
    /// this.
    OwnSide(const TetMesh& mesh, std::span<const std::int32_t> gap, const BarrierQuery& barriers,
            const Box3& extent = {});

    /// Is it a gap cell, one where faults meet included, or one that reaches across a barrier beyond the extent?
    [[nodiscard]] bool concerns(std::uint32_t cell) const { return gap_[cell] >= 0 || across_[cell] != 0; }

    /// The barycentric weights of a place in a cell, those of corners that it does not see left out and the others
    /// brought to the sum 1. On a fault itself it is that of the + side (BarrierQuery::off_barriers). Where it sees
    /// none otherwise, the nearest one it sees of the cells around. Sight is blocked by what bars estimation, by exact
    /// predicates; not by horizons and other surfaces that bar nothing. Safe from many threads.
    [[nodiscard]] VertexWeights weights(std::uint32_t cell, const Vec3& p, std::array<double, 4> barycentric) const;

    /// What the tessellation's field is made of at a place: weights() in a cell of concern, else the barycentric ones.
    [[nodiscard]] VertexWeights at(std::uint32_t cell, const Vec3& p, const std::array<double, 4>& barycentric) const {
        return concerns(cell) ? weights(cell, p, barycentric) : VertexWeights{mesh_.cells[cell], barycentric};
    }

  private:
    [[nodiscard]] VertexWeights nearest_seen_around(std::uint32_t cell, const Vec3& p) const;

    const TetMesh& mesh_;
    std::span<const std::int32_t> gap_;
    std::vector<char> across_;  ///< of each cell: reaches across a barrier beyond the extent
    const BarrierQuery& barriers_;
};

}  // namespace terratet
