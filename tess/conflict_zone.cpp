// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/conflict_zone.hpp"

#include <algorithm>
#include <cmath>

namespace terratet {

namespace {

/// With a cached centre c̃ within e of the true one c, and d the distance to c:  |d̃² − d²| ≤ 2de + e² ≤ αd² + e²(1 +
/// 1/α). α also covers the rounding of the radius to single precision, 2⁻²⁴, with room to spare.
constexpr double relative_slack = 1e-6;

/// A circumcentre's own rounding error grows as the cell gets flat: |a||b||c| over the determinant measures how much.
/// Up to this ratio it stays far below single precision.
constexpr double largest_condition = 1e5;

}  // namespace

ConflictSearch::ConflictSearch(const delaunay::Triangulation& triangulation, const Box3& domain)
    : triangulation_(triangulation),
      centre_(domain.center()),
      reach_(0.6 * std::max({domain.size().x, domain.size().y, domain.size().z})) {
    const double rounding = std::sqrt(3.0) * reach_ * 0x1p-23;
    slack_ = rounding * rounding * (1 + 1 / relative_slack);
}

void ConflictSearch::cache(delaunay::Cell cell, const CellPoints& p, const Circumsphere& sphere) const {
    const Vec3 a = p[1] - p[0];
    const Vec3 b = p[2] - p[0];
    const Vec3 c = p[3] - p[0];
    const double determinant = dot(a, cross(b, c));
    const double product = squared_length(a) * squared_length(b) * squared_length(c);
    const Vec3 centre = sphere.center - centre_;
    auto& info = cell->info();
    const bool trusted = product <= largest_condition * largest_condition * determinant * determinant &&
                         std::abs(centre.x) < reach_ && std::abs(centre.y) < reach_ && std::abs(centre.z) < reach_;
    info.center = {static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z)};
    info.squared_radius = trusted ? static_cast<float>(sphere.squared_radius) : delaunay::unknown_radius;
}

bool ConflictSearch::in_conflict(delaunay::Cell cell, const Vec3& relative, const delaunay::Point& point) const {
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

void ConflictSearch::find(const Vec3& point, delaunay::Cell start, Zone& zone) const {
    const Vec3 relative = point - centre_;
    const delaunay::Point exact = delaunay::to_cgal(point);
    zone.point = point;
    zone.boundary.clear();
    zone.cells.clear();
    zone.cells.push_back(start);
    start->tds_data().mark_in_conflict();
    for (std::size_t next = 0; next < zone.cells.size(); ++next) {
        const delaunay::Cell cell = zone.cells[next];
        for (int k = 0; k < 4; ++k) {
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
            }
        }
    }
    for (const auto& [cell, k] : zone.boundary) {
        cell->neighbor(k)->tds_data().clear();
    }
    for (const delaunay::Cell cell : zone.cells) {
        cell->tds_data().clear();
    }
}

}  // namespace terratet
