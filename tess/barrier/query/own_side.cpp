// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/query/own_side.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace terratet {
namespace {

constexpr std::size_t most_cells = 400;  ///< searched around a cell
constexpr double least_weight = 1e-12;   ///< less of what is seen says nothing
constexpr double beside = 1e-6;          ///< of an edge, short of its ends

}  // namespace

double mixed(const std::array<double, 4>& weights, const std::array<double, 4>& values, bool categorical) {
    if (categorical) {
        std::size_t best = 0;
        for (std::size_t k = 1; k < 4; ++k) {
            if (weights[k] > weights[best] || (weights[k] == weights[best] && values[k] < values[best])) {
                best = k;
            }
        }
        return std::isnan(weights[best]) ? weights[best] : values[best];
    }
    double mean = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        mean += weights[k] != 0 ? weights[k] * values[k] : 0;
    }
    return mean;
}

bool are_parted(const BarrierQuery& barriers, const Vec3& a, const Vec3& b) {
    const Vec3 short_of_end = beside * (b - a);
    return barriers.crosses_any(a + short_of_end, b - short_of_end);
}

OwnSide::OwnSide(const TetMesh& mesh, std::span<const std::int32_t> gap, const BarrierQuery& barriers,
                 const Box3& extent)
    : mesh_(mesh), gap_(gap), across_(mesh.cells.size(), 0), barriers_(barriers) {
    for (std::size_t c = 0; c < (barriers.empty() || extent.empty() ? 0 : mesh.cells.size()); ++c) {
        const auto& v = mesh.cells[c];
        if (gap[c] >= 0 ||
            std::ranges::all_of(v, [&](std::uint32_t corner) { return extent.contains(mesh.points[corner]); })) {
            continue;
        }
        for (std::size_t i = 1; i < 4 && across_[c] == 0; ++i) {
            for (std::size_t j = 0; j < i && across_[c] == 0; ++j) {
                across_[c] = are_parted(barriers, mesh.points[v[i]], mesh.points[v[j]]) ? 1 : 0;
            }
        }
    }
}

VertexWeights OwnSide::weights(std::uint32_t cell, const Vec3& place, std::array<double, 4> barycentric) const {
    const auto& corners = mesh_.cells[cell];
    const Vec3 p = barriers_.off_barriers(place);
    double sum = 0;
    std::size_t nearest = 4;
    for (std::size_t k = 0; k < 4; ++k) {
        if (barriers_.crosses_any(p, mesh_.points[corners[k]])) {
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
    if (nearest == 4) {
        return nearest_seen_around(cell, p);
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
                if (!barriers_.crosses_any(p, mesh_.points[v])) {
                    least = away;
                    found = {{v, v, v, v}, {1, 0, 0, 0}};
                }
            }
        }
    }
    return found;
}

}  // namespace terratet
