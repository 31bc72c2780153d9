// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The cells of a tessellation of sites and ghosts, made for walking (compact_delaunay.hpp): one cache line a cell.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "interp/base/huge_pages.hpp"
#include "interp/base/stolen_volumes.hpp"
#include "tess/geometry.hpp"

namespace terratet {

class CompactCells {
  public:
    struct alignas(64) Cell {
        std::array<std::int32_t, 4> vertex;     ///< positively oriented
        std::array<std::int32_t, 4> neighbour;  ///< opposite each vertex; −1 beyond the cube
        Vec3 center;            ///< of the circumsphere, to relative_center_error of its radius, mostly far better
        double squared_radius;  ///< from that centre to a vertex; NaN where the error is larger
    };
    static_assert(sizeof(Cell) == 64);

    /// What the cell gives to its vertices' Voronoi cells (cell_parts of stolen_volumes.hpp, split by split()).
    struct alignas(32) Parts {
        std::array<double, 4> of_vertex;
    };

    static constexpr std::int32_t ghost_count = 8;
    static constexpr double relative_center_error = 1e-11;

    /// The sites, then the ghosts.
    [[nodiscard]] std::span<const Vec3> points() const { return points_; }
    [[nodiscard]] std::span<const Cell> cells() const { return cells_; }
    [[nodiscard]] std::span<const Parts> parts() const { return parts_; }
    /// Where the parts of two neighbours meet: the cell whose centre it is, the one with the smaller number, which is
    /// on the axis of their facet to within the centres' error, however needle-like the facet. \param k  the facet's
    /// number in `cell`
    [[nodiscard]] std::int32_t split(std::int32_t cell, std::size_t k) const {
        const std::int32_t other = cells_[static_cast<std::size_t>(cell)].neighbour[k];
        return other >= 0 && other < cell ? other : cell;
    }
    [[nodiscard]] std::int32_t site_count() const { return static_cast<std::int32_t>(points_.size()) - ghost_count; }
    [[nodiscard]] bool is_ghost(std::int32_t vertex) const { return vertex >= site_count(); }

    /// Is q strictly inside the cell's circumsphere?
    [[nodiscard]] bool in_conflict(const Cell& cell, const Vec3& q) const {
        const double power = squared_distance(q, cell.center) - cell.squared_radius;
        if (std::abs(power) > power_error * cell.squared_radius) [[likely]] {
            return power < 0;
        }
        return in_conflict_exact(cell, q);
    }

  protected:
    CompactCells() = default;

    HugePageVector<Vec3> points_;
    HugePageVector<Cell> cells_;
    HugePageVector<Parts> parts_;  ///< of each cell

  private:
    // A centre off by δ, with the radius taken from it to a vertex p, shifts the power of q by 2 δ·(p − q): within
    // 2δ(d + r), which 8δ·r bounds wherever the sign is in doubt. The rest is rounding.
    static constexpr double power_error = 10 * relative_center_error;

    [[nodiscard]] bool in_conflict_exact(const Cell& cell, const Vec3& q) const;
};

}  // namespace terratet
