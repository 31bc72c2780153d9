// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/cavity.hpp"

#include <algorithm>

namespace terratet {
namespace {

/// A hint only. Zones are bound by memory: it makes queries a tenth faster.
void prefetch([[maybe_unused]] const CompactDelaunay::Cell& cell) {
#if defined(__GNUC__)
    __builtin_prefetch(&cell);
#endif
}

}  // namespace

void Cavity::find(const CompactDelaunay& mesh, const Vec3& q, const CompactDelaunay::Location& at) {
    grow(mesh, q, at.cell);
    if (!at.strictly_inside) {
        // Several cells contain q and the walk may end in any of them: start again from the first of the zone.
        const std::int32_t first = *std::min_element(cells.begin(), cells.end());
        if (first != cells.front()) {
            grow(mesh, q, first);
        }
    }
    number_vertices(mesh, q);
}

void Cavity::grow(const CompactDelaunay& mesh, const Vec3& q, std::int32_t start) {
    const auto all = mesh.cells();
    cells.assign(1, start);
    facets.clear();
    inside_.clear(all.size());
    inside_.insert(start);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& cell = all[static_cast<std::size_t>(cells[i])];
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t next = cell.neighbour[k];
            if (next >= 0) {
                if (inside_.contains(next)) {
                    continue;
                }
                const auto& candidate = all[static_cast<std::size_t>(next)];
                if (mesh.in_conflict(candidate, q)) {
                    inside_.insert(next);
                    cells.push_back(next);
                    for (const std::int32_t beyond : candidate.neighbour) {
                        if (beyond >= 0) {
                            prefetch(all[static_cast<std::size_t>(beyond)]);  // to be tested next
                        }
                    }
                    continue;
                }
            }
            const auto corner = [&](int j) { return cell.vertex[static_cast<std::size_t>(facet_corners[k][j])]; };
            facets.push_back({{corner(0), corner(1), corner(2)}, mesh.split(cells[i], k)});
        }
    }
}

void Cavity::number_vertices(const CompactDelaunay& mesh, const Vec3& q) {
    vertices.clear();
    points.clear();
    numbers_.clear(mesh.points().size());
    for (auto& facet : facets) {
        for (std::int32_t& v : facet.vertex) {
            if (!numbers_.contains(v)) {
                numbers_.insert(v, static_cast<std::int32_t>(vertices.size()));
                vertices.push_back(v);
                points.push_back(mesh.points()[static_cast<std::size_t>(v)] - q);
            }
            v = numbers_[v];
        }
    }
}

}  // namespace terratet
