// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A read-only copy of the Delaunay tessellation of sites, made for walking: one cache line a cell, cells and sites in
/// Morton order, circumspheres stored. All answers are exact: doubles decide where their error bound allows it, CGAL's
/// exact predicates elsewhere.
///
/// Eight ghosts, the corners of a cube around the sites' box, belong to it. So it has cells for any sites, be it one,
/// and every place within reach (strictly inside the cube) lies in a finite cell and has a bounded Voronoi cell.

#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "interp/huge_pages.hpp"
#include "interp/stolen_volumes.hpp"
#include "tess/geometry.hpp"

namespace terratet {

class SphereTree;

class CompactDelaunay {
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

    struct Location {
        std::int32_t cell;
        bool strictly_inside;  ///< not on one of its facets, so there is no other cell to choose
    };

    /// About 5 µs a site. \pre sites are distinct, acceptable, in Morton order (so that cells come out the same for any
    /// order of rows); fewer than 2^31 cells, which is some 300 million sites.
    explicit CompactDelaunay(std::span<const Vec3> sites);
    ~CompactDelaunay();

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

    /// The sites' box, well within reach.
    [[nodiscard]] const Box3& box() const { return box_; }

    [[nodiscard]] bool within_reach(const Vec3& q) const {
        return q.x > cube_.lo.x && q.y > cube_.lo.y && q.z > cube_.lo.z && q.x < cube_.hi.x && q.y < cube_.hi.y &&
               q.z < cube_.hi.z;
    }

    /// A cell near q to start a walk from. O(1).
    [[nodiscard]] std::int32_t start_near(const Vec3& q) const { return starts_[bin(q)]; }

    /// The cell that contains q, by a visibility walk, which always ends in a Delaunay tessellation (Devillers, Pion
    /// and Teillaud 2002). \pre within_reach(q)
    [[nodiscard]] Location locate(const Vec3& q, std::int32_t start) const;

    /// Is q inside the cell or on its boundary? \pre within_reach(q)
    [[nodiscard]] bool contains(const Cell& cell, const Vec3& q) const;

    /// Is q strictly inside the cell's circumsphere?
    [[nodiscard]] bool in_conflict(const Cell& cell, const Vec3& q) const {
        const double power = squared_distance(q, cell.center) - cell.squared_radius;
        if (std::abs(power) > power_error * cell.squared_radius) [[likely]] {
            return power < 0;
        }
        return in_conflict_exact(cell, q);
    }

    /// Its cells by their spheres, for vast conflict zones; built when first asked for.
    [[nodiscard]] const SphereTree& sphere_tree() const;

    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    // A centre off by δ, with the radius taken from it to a vertex p, shifts the power of q by 2 δ·(p − q): within
    // 2δ(d + r), which 8δ·r bounds wherever the sign is in doubt. The rest is rounding.
    static constexpr double power_error = 10 * relative_center_error;

    [[nodiscard]] std::size_t bin(const Vec3& q) const;
    [[nodiscard]] bool in_conflict_exact(const Cell& cell, const Vec3& q) const;
    void copy_tessellation();
    void fill_starts();

    Box3 cube_;
    HugePageVector<Vec3> points_;
    HugePageVector<Cell> cells_;
    HugePageVector<Parts> parts_;  ///< of each cell

    Box3 box_;
    std::array<std::int32_t, 3> bins_{};
    std::vector<std::int32_t> starts_;  ///< for each bin of a regular grid over the box, the cell at its centre

    mutable std::once_flag tree_wanted_;
    mutable std::unique_ptr<const SphereTree> tree_;
};

}  // namespace terratet
