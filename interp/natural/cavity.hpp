// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The conflict zone of a place: the cells whose circumsphere strictly contains it, which inserting it would replace.
/// Storage is kept between calls: one Cavity a thread. It holds 12 bytes for each cell and site of the largest mesh.
///
/// Cells with the place exactly on their sphere stay out. That is exact, not an approximation: on the plane of a common
/// facet both cells' powers of the place agree, so if one cell is strictly in conflict and the other is not, the place
/// is off that plane, on the inner side. Hence the zone is strictly star-shaped, no boundary facet is coplanar with the
/// place, and what the tied cells would add is of zero volume. Every vertex of the zone is on its boundary, since the
/// place can't be nearer to all corners of a Voronoi cell than the cell's own site is.

#include <array>
#include <cstdint>
#include <vector>

#include "interp/base/stamped.hpp"
#include "interp/sites/compact_delaunay.hpp"

namespace terratet {

class Cavity {
  public:
    /// A zone of more than three thousand cells, and of four times as many as facets, is found through the
    /// tessellation's SphereTree, which the first such zone builds: then most of its cells are in groups.
    ///
    /// The order of cells and vertices depends on the place alone, not on where the walk came from. `home`
    /// contains q, or is the first of the zone where several cells contain q.
    /// \pre q is none of the sites; `at` contains it
    void find(const CompactDelaunay& mesh, const Vec3& q, const CompactDelaunay::Location& at);

    /// All cells, those of the groups as well.
    [[nodiscard]] std::vector<std::int32_t> all_cells(const CompactDelaunay& mesh) const;

    /// The local number of one of the zone's vertices.
    [[nodiscard]] std::size_t number(std::int32_t vertex) const { return static_cast<std::size_t>(numbers_[vertex]); }

    /// Of the zone's boundary; det(a, b, c) > 0 seen from q.
    struct Facet {
        std::array<std::int32_t, 3> vertex;  ///< local
        std::int32_t split;                  ///< the cell whose centre is its split
    };

    std::int32_t home = 0;
    std::vector<std::int32_t> cells;     ///< the zone, but for
    std::vector<std::uint32_t> groups;   ///< groups of the SphereTree that lie wholly inside; mostly none
    std::vector<Facet> facets;           ///< its boundary
    std::vector<std::int32_t> vertices;  ///< q's natural neighbours, and perhaps some of zero weight
    std::vector<Vec3> points;            ///< theirs, relative to q

  private:
    /// \returns false when it gave up, after too many cells
    bool grow(const CompactDelaunay& mesh, const Vec3& q, std::int32_t start);
    void find_by_groups(const CompactDelaunay& mesh, const Vec3& q);
    void add_facet(const CompactDelaunay& mesh, std::int32_t cell, std::size_t k);
    void number_vertices(const CompactDelaunay& mesh, const Vec3& q);

    StampedSet inside_;
    StampedMap numbers_;
};

}  // namespace terratet
