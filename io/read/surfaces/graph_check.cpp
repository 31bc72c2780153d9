// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/surfaces/graph_check.hpp"

#include <algorithm>
#include <cmath>

namespace terratet {

bool is_graph(const Surface& surface) {
    Vec3 normal{0, 0, 0};
    for (const Triangle& t : surface.triangles) {
        normal = normal + cross(surface.vertices[t[1]] - surface.vertices[t[0]],
                                surface.vertices[t[2]] - surface.vertices[t[0]]);
    }
    const double size = length(normal);
    if (!(size > 0)) {
        return true;
    }
    struct Edge {
        double along, rise;
    };
    std::vector<Edge> edges;
    for (const Triangle& t : surface.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 run = surface.vertices[t[(k + 1) % 3]] - surface.vertices[t[k]];
            const double rise = std::abs(dot(run, normal)) / size;
            edges.push_back({std::sqrt(std::max(0.0, dot(run, run) - rise * rise)), rise});
        }
    }
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::ranges::nth_element(edges, middle, {}, &Edge::along);
    const double typical = middle->along;
    const auto steep =
        std::ranges::count_if(edges, [&](const Edge& e) { return e.rise > 2 * e.along && e.rise > 2 * typical; });
    return 20 * steep <= static_cast<std::ptrdiff_t>(edges.size());
}

}  // namespace terratet
