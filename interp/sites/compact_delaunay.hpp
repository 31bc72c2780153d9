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
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "interp/sites/compact_cells.hpp"
#include "interp/sites/sphere_tree.hpp"

namespace terratet {

class CompactDelaunay : public CompactCells {
  public:
    struct Location {
        std::int32_t cell;
        bool strictly_inside;  ///< not on one of its facets, so there is no other cell to choose
    };

    /// About 5 µs a site. Cells, and corners within each, are in an order that follows from the sites alone; where a
    /// few sites of the same box are exchanged, the order of all others stays. \pre sites are distinct, acceptable, in
    /// Morton order (so that cells come out the same for any order of rows); fewer than 2^31 cells, which is some 300
    /// million sites.
    explicit CompactDelaunay(std::span<const Vec3> sites);
    ~CompactDelaunay();

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

    /// Its cells by their spheres, for vast conflict zones; built when first asked for.
    [[nodiscard]] const SphereTree& sphere_tree() const;

    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    [[nodiscard]] std::size_t bin(const Vec3& q) const;
    void copy_tessellation();
    void fill_starts();

    Box3 cube_;
    Box3 box_;
    std::array<std::int32_t, 3> bins_{};
    std::vector<std::int32_t> starts_;  ///< for each bin of a regular grid over the box, the cell at its centre

    mutable std::once_flag tree_wanted_;
    mutable std::unique_ptr<const SphereTree> tree_;
};

}  // namespace terratet
