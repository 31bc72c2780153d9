// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/cavity.hpp"

#include <algorithm>

namespace terratet {
namespace {

constexpr std::int32_t outside = -1;

}  // namespace

void Cavity::find(const CompactDelaunay& mesh, const Vec3& q, const CompactDelaunay::Location& at) {
    grow(mesh, q, at.cell);
    if (!at.strictly_inside) {
        // Several cells contain q and the walk may end in any of them: start again from the first of the zone.
        const auto first =
            std::min_element(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.id < b.id; });
        if (first != cells.begin()) {
            grow(mesh, q, first->id);
        }
    }
}

void Cavity::grow(const CompactDelaunay& mesh, const Vec3& q, std::int32_t start) {
    cells.clear();
    centers.clear();
    vertices.clear();
    points.clear();
    cell_index_.clear();
    vertex_index_.clear();

    const auto add_vertex = [&](std::int32_t v) {
        const auto [local, is_new] = vertex_index_.insert(v, static_cast<std::int32_t>(vertices.size()));
        if (is_new) {
            vertices.push_back(v);
            points.push_back(mesh.points()[static_cast<std::size_t>(v)] - q);
        }
        return local;
    };
    const auto add_cell = [&](std::int32_t id, const CompactDelaunay::Cell& cell) {
        Cell local{id, {}, {}};
        for (std::size_t k = 0; k < 4; ++k) {
            local.vertex[k] = add_vertex(cell.vertex[k]);
        }
        cells.push_back(local);
        centers.push_back(cell.center - q);
    };

    cell_index_.insert(start, 0);
    add_cell(start, mesh.cells()[static_cast<std::size_t>(start)]);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& from = mesh.cells()[static_cast<std::size_t>(cells[i].id)];
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t id = from.neighbour[k];
            if (id < 0) {
                cells[i].neighbour[k] = outside;
                continue;
            }
            auto [local, is_new] = cell_index_.insert(id, static_cast<std::int32_t>(cells.size()));
            if (is_new) {
                const auto& cell = mesh.cells()[static_cast<std::size_t>(id)];
                if (mesh.in_conflict(cell, q)) {
                    add_cell(id, cell);
                } else {
                    local = outside;
                    cell_index_.replace_last(outside);
                }
            }
            cells[i].neighbour[k] = local;
        }
    }
}

}  // namespace terratet
