// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The conflict zone of a point: the cells whose circumsphere holds it, which an insertion would
/// replace.
///
/// Same result as CGAL's find_conflicts, about three times as fast: each finite cell caches its circumsphere in single
/// precision, and the exact predicate, which must load twelve coordinates, decides only what the cached sphere cannot.

#include <vector>

#include "tess/mesh/delaunay.hpp"
#include "tess/mesh/quality.hpp"

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

    /// False as soon as `accept` says so of a facet of the zone's boundary (its outer cell may be infinite): the zone
    /// is incomplete then. False, too, when `start` is not in conflict with `point`, as where a flat cell's
    /// circumcentre is off by rounding: what is round it then is no zone, and inserting there would break the mesh.
    template <class Accept>
    bool find(const Vec3& point, delaunay::Cell start, Zone& zone, const Accept& accept) const;

    bool find(const Vec3& point, delaunay::Cell start, Zone& zone) const {
        return find(point, start, zone, [](const delaunay::Facet&) { return true; });
    }

  private:
    [[nodiscard]] bool in_conflict(delaunay::Cell cell, const Vec3& relative, const delaunay::Point& point) const;
    static void clear_marks(const Zone& zone);

    const delaunay::Triangulation& triangulation_;
    Vec3 centre_;
    double reach_;  ///< spheres with a centre farther off are not cached
    double slack_;  ///< square of the largest error of a cached centre, over relative_slack

    /// With a cached centre c̃ within e of the true one c, and d the distance to c:  |d̃² − d²| ≤ 2de + e² ≤ αd² +
    /// e²(1 + 1/α). α also covers the rounding of the radius to single precision, 2⁻²⁴, with room to spare.
    static constexpr double relative_slack = 1e-6;
};

inline bool ConflictSearch::in_conflict(delaunay::Cell cell, const Vec3& relative, const delaunay::Point& point) const {
    const auto& info = cell->info();
    const double radius = info.squared_radius;
    const double d = squared_length(relative - Vec3{info.center[0], info.center[1], info.center[2]});
    const double uncertain = relative_slack * (d + radius) + slack_;
    if (d < radius - uncertain) {
        return true;
    }
    if (d > radius + uncertain) {
        return false;
    }
    return triangulation_.side_of_sphere(cell, point, true) == CGAL::ON_BOUNDED_SIDE;  // also for an unknown radius
}

template <class Accept>
bool ConflictSearch::find(const Vec3& point, delaunay::Cell start, Zone& zone, const Accept& accept) const {
    const Vec3 relative = point - centre_;
    const delaunay::Point exact = delaunay::to_cgal(point);
    zone.point = point;
    zone.boundary.clear();
    zone.cells.clear();
    if (!in_conflict(start, relative, exact)) {
        return false;
    }
    zone.cells.push_back(start);
    start->tds_data().mark_in_conflict();
    bool accepted = true;
    for (std::size_t next = 0; accepted && next < zone.cells.size(); ++next) {
        std::swap(zone.cells[next], zone.cells.back());  // depth first reaches the boundary sooner
        const delaunay::Cell cell = zone.cells[next];
        for (int k = 0; accepted && k < 4; ++k) {
            const delaunay::Cell neighbour = cell->neighbor(k);
            auto& mark = neighbour->tds_data();
            if (mark.is_in_conflict()) {
                continue;
            }
            if (mark.is_clear() && in_conflict(neighbour, relative, exact)) {
                mark.mark_in_conflict();
                zone.cells.push_back(neighbour);
            } else {
                mark.mark_on_boundary();
                zone.boundary.emplace_back(cell, k);
                accepted = accept(zone.boundary.back());
            }
        }
    }
    clear_marks(zone);
    return accepted;
}

}  // namespace terratet
