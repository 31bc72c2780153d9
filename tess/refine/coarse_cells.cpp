// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refine/coarse_cells.hpp"

#include <cmath>

#include "tess/mesh/gap_cell.hpp"
#include "tess/refine/live_cell.hpp"

namespace terratet {

namespace {

/// That a step of √2 takes for a cell that may have one now and varies: it triples the vertices of a volume.
constexpr double vertices_of_cell = 0.3;

}  // namespace

CoarseCells coarse_cells(const delaunay::Core& core, const InsertionRule& rule, const Box3& hull, double next) {
    const double now = rule.resolution().between();
    CoarseCells found;
    std::size_t varying = 0;
    const auto& triangulation = core.triangulation;
    for (auto cell = triangulation.finite_cells_begin(); cell != triangulation.finite_cells_end(); ++cell) {
        const JudgedCell judged_cell = judged(cell);
        const double radius = std::sqrt(judged_cell.sphere.squared_radius);
        if (!(radius >= now / 2 && radius < now) || !is_finite(judged_cell.sphere.center) ||
            radius >= rule.resolution().l_min(hull.clamped(judged_cell.sphere.center)) ||
            gap_barrier(judged_cell.vertices, core.vertices) >= 0) {
            continue;  // larger ones had their turn
        }
        const bool varies = rule.unsure(judged_cell);
        found.varying_volume += varies ? std::abs(judged_cell.sphere.six_volumes) / 6 : 0;
        if (radius >= next) {
            found.cells.push_back(cell);
            varying += varies ? 1 : 0;
        }
    }
    found.vertices_expected = static_cast<std::uint64_t>(vertices_of_cell * static_cast<double>(varying));
    return found;
}

}  // namespace terratet
