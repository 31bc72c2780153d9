// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A tetrahedral mesh whose every cell is known beforehand: each box of a grid in six tetrahedra round its diagonal
/// (Kuhn 1960), conforming, with the grid's nodes moved as a test likes.

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <vector>

#include "tess/tessellation.hpp"

namespace terratet::testing {

using Node = std::array<int, 3>;

/// Nodes 0…n on each axis, x slowest.
inline std::uint32_t node_index(const Node& node, const Node& boxes) {
    return static_cast<std::uint32_t>((node[0] * (boxes[1] + 1) + node[1]) * (boxes[2] + 1) + node[2]);
}

inline void find_neighbours(TetMesh& mesh) {
    struct Half {
        std::array<std::uint32_t, 3> facet;
        std::int32_t cell;
        std::size_t corner;
    };
    std::vector<Half> halves;
    halves.reserve(4 * mesh.cells.size());
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        for (std::size_t k = 0; k < 4; ++k) {
            const auto& v = mesh.cells[c];
            Half half{{v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]}, static_cast<std::int32_t>(c), k};
            std::sort(half.facet.begin(), half.facet.end());
            halves.push_back(half);
        }
    }
    std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) { return a.facet < b.facet; });
    mesh.neighbours.assign(mesh.cells.size(), {-1, -1, -1, -1});
    for (std::size_t i = 0; i + 1 < halves.size(); ++i) {
        const Half& a = halves[i];
        const Half& b = halves[i + 1];
        if (a.facet == b.facet) {
            mesh.neighbours[static_cast<std::size_t>(a.cell)][a.corner] = b.cell;
            mesh.neighbours[static_cast<std::size_t>(b.cell)][b.corner] = a.cell;
        }
    }
}

/// `place` gives each node its position; it must keep the boxes' sense of rotation.
inline TetMesh kuhn_mesh(const Node& boxes, const std::function<Vec3(const Node&)>& place) {
    TetMesh mesh;
    for (int i = 0; i <= boxes[0]; ++i) {
        for (int j = 0; j <= boxes[1]; ++j) {
            for (int k = 0; k <= boxes[2]; ++k) {
                mesh.points.push_back(place({i, j, k}));
            }
        }
    }
    for (int i = 0; i < boxes[0]; ++i) {
        for (int j = 0; j < boxes[1]; ++j) {
            for (int k = 0; k < boxes[2]; ++k) {
                std::array<std::size_t, 3> axis{0, 1, 2};
                do {
                    Node node{i, j, k};
                    std::array<std::uint32_t, 4> cell{node_index(node, boxes)};
                    for (std::size_t step = 0; step < 3; ++step) {
                        ++node[axis[step]];
                        cell[step + 1] = node_index(node, boxes);
                    }
                    const bool even = (axis[1] + 3 - axis[0]) % 3 == 1;
                    if (!even) {
                        std::swap(cell[2], cell[3]);
                    }
                    mesh.cells.push_back(cell);
                } while (std::next_permutation(axis.begin(), axis.end()));
            }
        }
    }
    std::sort(mesh.cells.begin(), mesh.cells.end());
    find_neighbours(mesh);
    return mesh;
}

}  // namespace terratet::testing
