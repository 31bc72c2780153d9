// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refine/touched_cells.hpp"

#include <algorithm>
#include <unordered_set>

#include "tess/refine/live_cell.hpp"

namespace terratet {
namespace {

using delaunay::Cell;

struct CellHash {
    std::size_t operator()(Cell cell) const { return std::hash<const void*>()(&*cell); }
};

class TouchedCells {
  public:
    explicit TouchedCells(const delaunay::Core& core) : triangulation_(core.triangulation) {}

    void add_around(delaunay::VertexHandle vertex) {
        star_.clear();
        triangulation_.finite_incident_cells(vertex, std::back_inserter(star_));
        for (const Cell cell : star_) {
            add(cell);
        }
    }

    /// They hang together: those whose sphere holds a place do, and the cells that hold the box's places.
    void add_meeting(const Box3& box) {
        const Cell start = triangulation_.locate(delaunay::to_cgal(box.center()));
        if (triangulation_.is_infinite(start)) {
            return;
        }
        std::unordered_set<Cell, CellHash> seen{start};
        std::vector<Cell> waiting{start};
        while (!waiting.empty()) {
            const Cell cell = waiting.back();
            waiting.pop_back();
            add(cell);
            for (int k = 0; k < 4; ++k) {
                const Cell next = cell->neighbor(k);
                if (!triangulation_.is_infinite(next) && !seen.contains(next) && meets(next, box)) {
                    seen.insert(next);
                    waiting.push_back(next);
                }
            }
        }
    }

    [[nodiscard]] std::vector<Cell> take() { return std::move(cells_); }

  private:
    void add(Cell cell) {
        if (found_.insert(cell).second) {
            cells_.push_back(cell);
        }
    }

    /// Rather too often than too seldom.
    static bool meets(Cell cell, const Box3& box) {
        const Circumsphere sphere = judged(cell).sphere;
        const double d = squared_distance(sphere.center, box.clamped(sphere.center));
        return !(d > sphere.squared_radius * (1 + 1e-6));
    }

    const delaunay::Triangulation& triangulation_;
    std::unordered_set<Cell, CellHash> found_;
    std::vector<Cell> cells_;
    std::vector<Cell> star_;
};

}  // namespace

std::vector<Cell> touched_cells(const delaunay::Core& core, const Touched& touched, std::uint32_t first_new) {
    std::vector<bool> asked(core.vertices.size());
    for (const std::uint32_t vertex : touched.vertices) {
        asked[vertex] = true;
    }
    TouchedCells cells(core);
    for (const auto handle : core.triangulation.finite_vertex_handles()) {
        if (handle->info() >= first_new || asked[handle->info()]) {
            cells.add_around(handle);
        }
    }
    for (const Box3& box : touched.boxes) {
        cells.add_meeting(box);
    }
    return cells.take();
}

}  // namespace terratet
