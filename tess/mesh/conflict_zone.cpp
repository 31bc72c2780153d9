// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mesh/conflict_zone.hpp"

#include <algorithm>
#include <cmath>

namespace terratet {

namespace {

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
    const double product = squared_distance(p[1], p[0]) * squared_distance(p[2], p[0]) * squared_distance(p[3], p[0]);
    const double determinant = sphere.six_volumes;
    const Vec3 centre = sphere.center - centre_;
    auto& info = cell->info();
    const bool trusted = product <= largest_condition * largest_condition * determinant * determinant &&
                         std::abs(centre.x) < reach_ && std::abs(centre.y) < reach_ && std::abs(centre.z) < reach_;
    info.center = {static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z)};
    info.squared_radius = trusted ? static_cast<float>(sphere.squared_radius) : delaunay::unknown_radius;
}

void ConflictSearch::clear_marks(const Zone& zone) {
    for (const auto& [cell, k] : zone.boundary) {
        cell->neighbor(k)->tds_data().clear();
    }
    for (const delaunay::Cell cell : zone.cells) {
        cell->tds_data().clear();
    }
}

}  // namespace terratet
