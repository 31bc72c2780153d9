// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The conflict zone of a place: the cells whose circumsphere strictly contains it, which inserting it would replace.
/// Numbered locally, positions relative to the place. Storage is kept between calls: one Cavity a thread.
///
/// Cells with the place exactly on their sphere stay out. That is exact, not an approximation: on the plane of a common
/// facet both cells' powers of the place agree, so if one cell is strictly in conflict and the other is not, the place
/// is off that plane, on the inner side. Hence the zone is strictly star-shaped, no boundary facet is coplanar with the
/// place, and what the tied cells would add is of zero volume.

#include <array>
#include <cstdint>
#include <vector>

#include "interp/compact_delaunay.hpp"
#include "interp/id_map.hpp"

namespace terratet {

class Cavity {
  public:
    struct Cell {
        std::int32_t id;                        ///< in the tessellation
        std::array<std::int32_t, 4> vertex;     ///< local
        std::array<std::int32_t, 4> neighbour;  ///< local; negative where the zone ends
    };

    /// The order of cells and vertices depends on the place alone, not on where the walk came from. The first cell
    /// contains q, or is the first of the zone where several cells contain q.
    /// \pre q is none of the sites; `at` contains it
    void find(const CompactDelaunay& mesh, const Vec3& q, const CompactDelaunay::Location& at);

    std::vector<Cell> cells;
    std::vector<Vec3> centers;           ///< of the cells' circumspheres, relative to q
    std::vector<std::int32_t> vertices;  ///< of the zone: q's natural neighbours, and perhaps some of zero weight
    std::vector<Vec3> points;            ///< theirs, relative to q

  private:
    void grow(const CompactDelaunay& mesh, const Vec3& q, std::int32_t start);
    void add_first(const CompactDelaunay& mesh, const Vec3& q, std::int32_t id);
    /// \param from  local number of the cell through which it was found: three of the four vertices are known
    void add_next(const CompactDelaunay& mesh, const Vec3& q, std::int32_t id, std::int32_t from);
    std::int32_t add_vertex(const CompactDelaunay& mesh, const Vec3& q, std::int32_t vertex);

    IdMap cell_index_;
    IdMap vertex_index_;
};

}  // namespace terratet
