// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/cells/crossing_edges.hpp"

#include <algorithm>

#include "tess/base/tetrahedron.hpp"

namespace terratet {

std::vector<CrossingEdge> fault_crossing_edges(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers) {
    std::vector<CrossingEdge> crossing;
    for (std::size_t f = 0; f < model.barriers.size(); ++f) {
        const auto barrier = static_cast<std::int32_t>(f);
        const Box3 box = bounding_box(model.barriers[f].sheet.vertices);
        const auto is_own_seed = [&](std::uint32_t v) {
            return model.vertices[v].role == Role::seed && barriers.meet(barrier, model.vertices[v].owner);
        };
        std::vector<std::array<std::uint32_t, 2>> suspects;
        for (const auto& cell : mesh.cells) {
            for (const auto& [i, j] : cell_edges) {
                const auto [a, b] = std::minmax(cell[i], cell[j]);
                if (box.meets_box_of(mesh.points[a], mesh.points[b]) && !(is_own_seed(a) && is_own_seed(b))) {
                    suspects.push_back({a, b});
                }
            }
        }
        std::ranges::sort(suspects);
        suspects.erase(std::ranges::unique(suspects).begin(), suspects.end());
        for (const auto& [a, b] : suspects) {
            if (barriers.crosses(barrier, mesh.points[a], mesh.points[b])) {
                crossing.push_back({a, b, barrier});
            }
        }
    }
    return crossing;
}

}  // namespace terratet
