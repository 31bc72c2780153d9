// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/surfaces/sticks.hpp"

#include <algorithm>

namespace terratet {
namespace {

using Stick = std::vector<std::uint32_t>;

/// From one stick to the next, always over the shorter diagonal.
void join(Surface& surface, const Stick& a, const Stick& b) {
    const auto& at = surface.vertices;
    std::size_t i = 0;
    std::size_t j = 0;
    while (i + 1 < a.size() || j + 1 < b.size()) {
        const bool along_a = j + 1 == b.size() ||
                             (i + 1 < a.size() && distance(at[a[i + 1]], at[b[j]]) <= distance(at[a[i]], at[b[j + 1]]));
        surface.triangles.push_back(along_a ? Triangle{a[i], b[j], a[i + 1]} : Triangle{a[i], b[j], b[j + 1]});
        i += along_a ? 1 : 0;
        j += along_a ? 0 : 1;
    }
}

}  // namespace

Surface surface_of_sticks(std::string name, std::vector<std::vector<Vec3>> sticks) {
    Surface surface;
    surface.name = std::move(name);
    std::vector<Stick> indices;
    for (std::vector<Vec3>& stick : sticks) {
        stick.erase(std::unique(stick.begin(), stick.end()), stick.end());
        if (stick.size() < 2) {
            continue;
        }
        if (!indices.empty() && dot(stick.back() - stick.front(), surface.vertices[indices.back().back()] -
                                                                      surface.vertices[indices.back().front()]) < 0) {
            std::ranges::reverse(stick);
        }
        Stick index;
        for (const Vec3& point : stick) {
            index.push_back(static_cast<std::uint32_t>(surface.vertices.size()));
            surface.vertices.push_back(point);
        }
        indices.push_back(std::move(index));
    }
    for (std::size_t k = 1; k < indices.size(); ++k) {
        join(surface, indices[k - 1], indices[k]);
    }
    return surface;
}

}  // namespace terratet
