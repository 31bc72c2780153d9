// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/own_side.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace terratet {
namespace {

constexpr std::size_t most_cells = 400;  ///< searched around a cell
constexpr double least_weight = 1e-12;   ///< less of what is seen says nothing

}  // namespace

VertexWeights OwnSide::weights(std::uint32_t cell, const Vec3& p, std::array<double, 4> barycentric) const {
    const auto& corners = mesh_.cells[cell];
    double sum = 0;
    std::size_t nearest = 4;
    for (std::size_t k = 0; k < 4; ++k) {
        if (faults_.crosses_any(p, mesh_.points[corners[k]])) {
            barycentric[k] = 0;
            continue;
        }
        barycentric[k] = std::max(barycentric[k], 0.0);
        sum += barycentric[k];
        if (nearest == 4 ||
            squared_distance(p, mesh_.points[corners[k]]) < squared_distance(p, mesh_.points[corners[nearest]])) {
            nearest = k;
        }
    }
    if (nearest == 4 && !faults_.crosses_any(p, p)) {
        return nearest_seen_around(cell, p);
    }
    if (nearest == 4) {  // on the fault: either side is its own
        const auto corner = std::ranges::min_element(
            corners, {}, [&](std::uint32_t v) { return squared_distance(p, mesh_.points[v]); });
        nearest = static_cast<std::size_t>(corner - corners.begin());
    }
    if (!(sum > least_weight)) {
        barycentric = {};
        barycentric[nearest] = sum = 1;
    }
    for (double& w : barycentric) {
        w /= sum;
    }
    return {corners, barycentric};
}

VertexWeights OwnSide::nearest_seen_around(std::uint32_t cell, const Vec3& p) const {
    std::vector<std::uint32_t> cells{cell};
    std::vector<std::uint32_t> tried;
    double least = std::numeric_limits<double>::infinity();
    VertexWeights found;
    found.weights.fill(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < cells.size() && i < most_cells; ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t v = mesh_.cells[cells[i]][k];
            const std::int32_t next = mesh_.neighbours[cells[i]][k];
            if (next >= 0 && std::ranges::find(cells, static_cast<std::uint32_t>(next)) == cells.end()) {
                cells.push_back(static_cast<std::uint32_t>(next));
            }
            const double away = squared_distance(p, mesh_.points[v]);
            if (away < least && std::ranges::find(tried, v) == tried.end()) {
                tried.push_back(v);
                if (!faults_.crosses_any(p, mesh_.points[v])) {
                    least = away;
                    found = {{v, v, v, v}, {1, 0, 0, 0}};
                }
            }
        }
    }
    return found;
}

}  // namespace terratet
