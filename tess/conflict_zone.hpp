// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The conflict zone of a point: the cells whose circumsphere holds it, which an insertion would replace. Private to
/// this floor.
///
/// Same result as CGAL's find_conflicts, about three times as fast: each finite cell caches its circumsphere in single
/// precision, and the exact predicate, which must load twelve coordinates, decides only what the cached sphere cannot.

#include <vector>

#include "tess/delaunay.hpp"
#include "tess/quality.hpp"

namespace terratet {

struct Zone {
    Vec3 point;
    std::vector<delaunay::Facet> boundary;  ///< as (cell inside the zone, index of the vertex opposite)
    std::vector<delaunay::Cell> cells;
};

class ConflictSearch {
  public:
    /// `domain` bounds the vertices; spheres are cached relative to its centre.
    ConflictSearch(const delaunay::Triangulation& triangulation, const Box3& domain);

    /// Caches a finite cell's circumsphere. A cell without cache is decided exactly: correct, but slow.
    void cache(delaunay::Cell cell, const CellPoints& points, const Circumsphere& sphere) const;

    /// \pre `start` is in conflict with `point`.
    void find(const Vec3& point, delaunay::Cell start, Zone& zone) const;

  private:
    [[nodiscard]] bool in_conflict(delaunay::Cell cell, const Vec3& relative, const delaunay::Point& point) const;

    const delaunay::Triangulation& triangulation_;
    Vec3 centre_;
    double reach_;  ///< spheres with a centre farther off are not cached
    double slack_;  ///< square of the largest error of a cached centre, over relative_slack
};

}  // namespace terratet
