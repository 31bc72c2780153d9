// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mesh/gap_cell.hpp"

namespace terratet {

std::int32_t gap_barrier(const std::array<std::uint32_t, 4>& cell, std::span<const Vertex> vertices) {
    const std::int32_t owner = vertices[cell[0]].owner;
    bool plus = false;
    bool minus = false;
    for (const std::uint32_t v : cell) {
        const Vertex& vertex = vertices[v];
        if (vertex.role != Role::seed || vertex.owner != owner) {
            return -1;
        }
        plus = plus || vertex.side > 0;
        minus = minus || vertex.side < 0;
    }
    return plus && minus ? owner : -1;
}

}  // namespace terratet
