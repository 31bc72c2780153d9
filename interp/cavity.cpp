// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/cavity.hpp"

#include <algorithm>

namespace terratet {
namespace {

constexpr std::int32_t outside = -1;
constexpr std::int32_t unknown = -2;

/// Which of four holds the value; without branches, as none could be predicted. \pre exactly one does
std::size_t index_of(const std::array<std::int32_t, 4>& four, std::int32_t value) {
    return static_cast<std::size_t>((four[1] == value) + 2 * (four[2] == value) + 3 * (four[3] == value));
}

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

    add_first(mesh, q, start);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& from = mesh.cells()[static_cast<std::size_t>(cells[i].id)];
        for (std::size_t k = 0; k < 4; ++k) {
            if (cells[i].neighbour[k] != unknown) {
                continue;  // set from the other side
            }
            const std::int32_t id = from.neighbour[k];
            if (id < 0) {
                cells[i].neighbour[k] = outside;
                continue;
            }
            const auto [local, is_new] = cell_index_.insert(id, static_cast<std::int32_t>(cells.size()));
            if (is_new) {
                const auto& cell = mesh.cells()[static_cast<std::size_t>(id)];
                if (mesh.in_conflict(cell, q)) {
                    add_next(mesh, q, id, static_cast<std::int32_t>(i));
                    cells[i].neighbour[k] = local;
                } else {
                    cell_index_.replace_last(outside);
                    cells[i].neighbour[k] = outside;
                }
            } else {
                cells[i].neighbour[k] = local;
                if (local >= 0) {
                    const auto& other = mesh.cells()[static_cast<std::size_t>(id)];
                    cells[static_cast<std::size_t>(local)].neighbour[index_of(other.neighbour, cells[i].id)] =
                        static_cast<std::int32_t>(i);
                }
            }
        }
    }
}

void Cavity::add_first(const CompactDelaunay& mesh, const Vec3& q, std::int32_t id) {
    const auto& cell = mesh.cells()[static_cast<std::size_t>(id)];
    cell_index_.insert(id, 0);
    cells.push_back({id, {0, 1, 2, 3}, {unknown, unknown, unknown, unknown}});
    centers.push_back(cell.center - q);
    for (std::size_t k = 0; k < 4; ++k) {
        add_vertex(mesh, q, cell.vertex[k]);
    }
}

void Cavity::add_next(const CompactDelaunay& mesh, const Vec3& q, std::int32_t id, std::int32_t from) {
    const auto& cell = mesh.cells()[static_cast<std::size_t>(id)];
    const Cell& known = cells[static_cast<std::size_t>(from)];
    const auto& known_vertices = mesh.cells()[static_cast<std::size_t>(known.id)].vertex;
    const std::size_t apex = index_of(cell.neighbour, known.id);
    for (const std::int32_t neighbour : cell.neighbour) {
        if (neighbour >= 0) {
            prefetch(mesh.cells()[static_cast<std::size_t>(neighbour)]);  // to be tested next
        }
    }
    Cell next{id, {}, {unknown, unknown, unknown, unknown}};
    next.neighbour[apex] = from;
    for (std::size_t k = 0; k < 4; ++k) {
        next.vertex[k] =
            k == apex ? add_vertex(mesh, q, cell.vertex[k]) : known.vertex[index_of(known_vertices, cell.vertex[k])];
    }
    cells.push_back(next);
    centers.push_back(cell.center - q);
}

std::int32_t Cavity::add_vertex(const CompactDelaunay& mesh, const Vec3& q, std::int32_t vertex) {
    const auto [local, is_new] = vertex_index_.insert(vertex, static_cast<std::int32_t>(vertices.size()));
    if (is_new) {
        vertices.push_back(vertex);
        points.push_back(mesh.points()[static_cast<std::size_t>(vertex)] - q);
    }
    return local;
}

}  // namespace terratet
