// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/round_off.hpp"

#include <algorithm>

namespace terratet {
namespace {

constexpr int rounds = 40;
constexpr double resolved_radius = 5;  ///< in edge lengths
constexpr double largest_move = 0.2;   ///< in edge lengths, before a finer spacing is wanted

using Neighbours = std::vector<std::vector<std::uint32_t>>;

/// Marks the neighbours of the marked as well.
void widen(std::vector<char>& marked, const Neighbours& all) {
    const std::vector<char> before = marked;
    for (std::size_t v = 0; v < all.size(); ++v) {
        for (const std::uint32_t w : before[v] != 0 ? all[v] : std::vector<std::uint32_t>{}) {
            marked[w] = 1;
        }
    }
}

}  // namespace

std::vector<Vec3> round_bends(SheetComplex& complex, const SizeField& sizes) {
    const std::vector<Vec3> before = complex.points;
    const std::size_t count = before.size();
    Neighbours all(count);
    Neighbours along_rim(count);
    std::vector<char> free(count, 1);
    const EdgeTable edges(complex.triangles);
    for (const EdgeTable::Edge& e : edges.edges()) {
        all[e.a].push_back(e.b);
        all[e.b].push_back(e.a);
        const auto of_edge = edges.triangles(e);
        if (of_edge.size() == 1) {
            along_rim[e.a].push_back(e.b);
            along_rim[e.b].push_back(e.a);
        } else if (!is_smooth(complex, of_edge)) {
            free[e.a] = 0;
            free[e.b] = 0;
        }
    }
    std::vector<std::int64_t> sheet_at(count, -1);
    for (std::size_t t = 0; t < complex.triangles.size(); ++t) {  // sheets may touch in a point alone
        for (const std::uint32_t v : complex.triangles[t]) {
            free[v] = sheet_at[v] < 0 || sheet_at[v] == complex.sheet[t] ? free[v] : 0;
            sheet_at[v] = complex.sheet[t];
        }
    }
    std::vector<char> unresolved(count, 0);
    for (int round = 0; round < rounds; ++round) {
        const std::vector<Vec3> normals = vertex_normals({complex.points, complex.triangles});
        std::ranges::fill(unresolved, 0);
        for (std::size_t v = 0; v < count; ++v) {
            const double size = sizes.at(before[v]);
            for (const std::uint32_t w : free[v] != 0 ? all[v] : std::vector<std::uint32_t>{}) {
                const Vec3 step = complex.points[w] - complex.points[v];
                const double across = std::max(length(step), 0.5 * size);
                if (free[w] != 0 && std::abs(dot(step, normals[v])) > across * across / (2 * resolved_radius * size)) {
                    unresolved[v] = 1;
                }
            }
        }
        if (std::ranges::none_of(unresolved, [](char mark) { return mark != 0; })) {
            break;
        }
        std::vector<char> moving = unresolved;
        widen(moving, all);
        widen(moving, all);
        std::vector<Vec3> moved = complex.points;
        for (std::size_t v = 0; v < count; ++v) {
            const auto& follow = along_rim[v].empty() ? all[v] : along_rim[v];
            if (moving[v] != 0 && free[v] != 0 && !follow.empty()) {
                Vec3 mean;
                for (const std::uint32_t w : follow) {
                    mean = mean + complex.points[w] / static_cast<double>(follow.size());
                }
                moved[v] = complex.points[v] + 0.6 * dot(mean - complex.points[v], normals[v]) * normals[v];
            }
        }
        complex.points = std::move(moved);
    }
    std::vector<Vec3> places;
    for (std::size_t v = 0; v < count; ++v) {
        if (unresolved[v] != 0 || distance(before[v], complex.points[v]) > largest_move * sizes.at(before[v])) {
            places.push_back(before[v]);
        }
    }
    return places;
}

}  // namespace terratet
