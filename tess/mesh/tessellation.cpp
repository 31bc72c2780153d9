// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/tessellation.hpp"

#include <algorithm>
#include <cassert>

#include "tess/base/poll.hpp"
#include "tess/mesh/bulk_insertion.hpp"
#include "tess/mesh/delaunay.hpp"

namespace terratet {

namespace {

using delaunay::Cell;

/// Even permutations of four that bring each position to the front and each of the rest to the second place.
constexpr std::uint8_t rotations[12][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 0, 3, 2},
                                           {1, 3, 2, 0}, {1, 2, 0, 3}, {2, 0, 1, 3}, {2, 1, 3, 0},
                                           {2, 3, 0, 1}, {3, 0, 2, 1}, {3, 2, 1, 0}, {3, 1, 0, 2}};

struct FlatCell {
    std::array<std::uint32_t, 4> vertices;
    std::array<std::uint8_t, 4> order;  ///< where each vertex stands in CGAL's cell
    Cell cell;
};

/// The cell's vertices with the smallest first, the smallest of the others second, orientation kept.
FlatCell canonical(Cell cell) {
    FlatCell best{};
    for (const auto& rotation : rotations) {
        FlatCell candidate{{}, {rotation[0], rotation[1], rotation[2], rotation[3]}, cell};
        for (std::size_t k = 0; k < 4; ++k) {
            candidate.vertices[k] = cell->vertex(rotation[k])->info();
        }
        if (&rotation == &rotations[0] || candidate.vertices < best.vertices) {
            best = candidate;
        }
    }
    return best;
}

}  // namespace

delaunay::Core& delaunay::core(Tessellation& tessellation) {
    return *tessellation.core_;
}

Tessellation::Tessellation() : core_(std::make_unique<delaunay::Core>()) {}
Tessellation::~Tessellation() = default;
Tessellation::Tessellation(Tessellation&&) noexcept = default;
Tessellation& Tessellation::operator=(Tessellation&&) noexcept = default;

void Tessellation::insert(std::span<const Vertex> vertices, const Poll& poll) {
    delaunay::Core& core = *core_;
    PatientPoll go_on(poll);
    std::vector<std::pair<delaunay::Point, std::uint32_t>> points;
    points.reserve(vertices.size());
    core.vertices.reserve(core.vertices.size() + vertices.size());
    for (const Vertex& vertex : vertices) {
        assert(is_acceptable(vertex.position) && vertex.id >= core.next_id);
        points.emplace_back(delaunay::to_cgal(vertex.position), static_cast<std::uint32_t>(core.vertices.size()));
        core.vertices.push_back(vertex);
        core.next_id = vertex.id + 1;
    }
    delaunay::insert(core.triangulation, points, go_on);
    assert(core.triangulation.number_of_vertices() == core.vertices.size());
}

std::span<const Vertex> Tessellation::vertices() const {
    return core_->vertices;
}

std::size_t Tessellation::cell_count() const {
    const auto& triangulation = core_->triangulation;
    return triangulation.dimension() == 3 ? triangulation.number_of_finite_cells() : 0;
}

std::uint64_t Tessellation::next_id() const {
    return core_->next_id;
}

TetMesh Tessellation::mesh() const {
    auto& triangulation = core_->triangulation;
    TetMesh mesh;
    mesh.points.reserve(core_->vertices.size());
    for (const Vertex& vertex : core_->vertices) {
        mesh.points.push_back(vertex.position);
    }
    if (triangulation.dimension() < 3) {
        return mesh;
    }
    std::vector<FlatCell> cells;
    cells.reserve(triangulation.number_of_cells());
    for (auto cell = triangulation.all_cells_begin(); cell != triangulation.all_cells_end(); ++cell) {
        if (triangulation.is_infinite(cell)) {
            cell->info().tag = no_index;
        } else {
            cells.push_back(canonical(cell));
        }
    }
    std::ranges::sort(cells, {}, &FlatCell::vertices);
    for (std::uint32_t c = 0; c < cells.size(); ++c) {
        cells[c].cell->info().tag = c;
    }
    mesh.cells.reserve(cells.size());
    mesh.neighbours.reserve(cells.size());
    for (const FlatCell& flat : cells) {
        mesh.cells.push_back(flat.vertices);
        auto& neighbours = mesh.neighbours.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) {
            neighbours[k] =
                static_cast<std::int32_t>(flat.cell->neighbor(flat.order[k])->info().tag);  // none becomes −1
        }
    }
    return mesh;
}

bool Tessellation::is_delaunay() const {
    return core_->triangulation.is_valid();
}

}  // namespace terratet
