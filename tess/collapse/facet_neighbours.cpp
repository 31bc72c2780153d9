// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/collapse/facet_neighbours.hpp"

#include <algorithm>
#include <tuple>

#include "tess/geometry.hpp"

namespace terratet {

std::vector<std::array<std::int32_t, 4>> neighbours_of(const std::vector<std::array<std::uint32_t, 4>>& cells) {
    struct Side {
        Triangle key;
        std::uint32_t cell;
        std::uint32_t facet;
    };
    std::vector<Side> sides;
    sides.reserve(4 * cells.size());
    for (std::uint32_t c = 0; c < cells.size(); ++c) {
        for (std::uint32_t k = 0; k < 4; ++k) {
            Triangle key{cells[c][(k + 1) % 4], cells[c][(k + 2) % 4], cells[c][(k + 3) % 4]};
            std::ranges::sort(key);
            sides.push_back({key, c, k});
        }
    }
    std::ranges::sort(sides, [](const Side& a, const Side& b) {
        return std::tie(a.key, a.cell, a.facet) < std::tie(b.key, b.cell, b.facet);
    });
    std::vector<std::array<std::int32_t, 4>> neighbours(cells.size(), {-1, -1, -1, -1});
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const Side& a = sides[i];
        const Side& b = sides[i + 1];
        if (a.key == b.key) {
            neighbours[a.cell][a.facet] = static_cast<std::int32_t>(b.cell);
            neighbours[b.cell][b.facet] = static_cast<std::int32_t>(a.cell);
        }
    }
    return neighbours;
}

}  // namespace terratet
