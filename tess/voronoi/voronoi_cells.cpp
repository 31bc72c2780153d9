// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/voronoi/voronoi_cells.hpp"

#include <algorithm>
#include <array>

#include "tess/voronoi/clip_complex.hpp"
#include "tess/voronoi/voronoi_dual.hpp"
#include "tess/voronoi/voronoi_measures.hpp"

namespace terratet {
namespace {

constexpr std::int32_t unknown = -1;
constexpr std::int32_t outside = -2;

/// By vertex: the region of the cells about it; `outside` where all of these are beyond what bounds the model.
std::vector<std::int32_t> vertex_regions(const TetMesh& mesh, const CellRegions& regions) {
    std::vector<std::int32_t> result(mesh.points.size(), outside);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (regions.beyond[c] != 0) {
            continue;
        }
        for (const std::uint32_t v : mesh.cells[c]) {
            if (result[v] < 0) {
                result[v] = std::max(result[v], regions.region[c]);
            }
        }
    }
    return result;
}

class CellFinder {
  public:
    CellFinder(const Model& model, const TetMesh& mesh, const CellRegions& regions, const BarrierQuery& barriers)
        : model_(model), barriers_(barriers), region_(vertex_regions(mesh, regions)) {}

    VoronoiCells run(VoronoiComplex complex) {
        number_cells(complex);
        found_.complex.points = std::move(complex.points);
        for (const VoronoiWall& wall : complex.walls) {
            add(complex.polygon(wall), wall);
        }
        drop_unused_points(found_.complex);
        spread_regions();
        return std::move(found_);
    }

  private:
    void number_cells(const VoronoiComplex& complex) {
        number_.assign(model_.vertices.size(), unknown);
        for (const VoronoiWall& wall : complex.walls) {
            number_[wall.cell] = 0;
            if (wall.beyond >= 0) {
                number_[static_cast<std::size_t>(wall.beyond)] = 0;
            }
        }
        for (std::uint32_t v = 0; v < number_.size(); ++v) {
            if (number_[v] == 0 && region_[v] == outside) {
                number_[v] = outside;
            } else if (number_[v] == 0) {
                number_[v] = static_cast<std::int32_t>(found_.vertex.size());
                found_.vertex.push_back(v);
                found_.region.push_back(region_[v]);
            }
        }
    }

    void add(std::span<const std::uint32_t> polygon, const VoronoiWall& wall) {
        const std::int32_t cell = number_[wall.cell];
        if (wall.beyond < 0) {
            if (cell >= 0) {
                push(polygon, cell, wall.beyond, unknown);
            }
            return;
        }
        const auto other = static_cast<std::uint32_t>(wall.beyond);
        const std::int32_t beyond = number_[other];
        if (cell >= 0 && beyond >= 0) {
            push(polygon, cell, beyond, barrier_between(wall.cell, other));
        } else if (cell >= 0) {
            push(polygon, cell, beyond_bound, bound_between(wall.cell, other));
        } else if (beyond >= 0) {
            turned_.assign(polygon.rbegin(), polygon.rend());
            push(turned_, beyond, beyond_bound, bound_between(wall.cell, other));
        }
    }

    void push(std::span<const std::uint32_t> polygon, std::int32_t cell, std::int32_t beyond, std::int32_t barrier) {
        found_.complex.add(polygon, static_cast<std::uint32_t>(cell), beyond);
        found_.barrier.push_back(barrier);
    }

    /// The one whose sheet parts two seeds.
    [[nodiscard]] std::int32_t barrier_between(std::uint32_t a, std::uint32_t b) const {
        const Vertex& u = model_.vertices[a];
        const Vertex& v = model_.vertices[b];
        if (u.role != Role::seed || v.role != Role::seed) {
            return unknown;
        }
        for (const std::int32_t owner : {u.owner, v.owner}) {
            if (barriers_.crosses(owner, u.position, v.position)) {
                return owner;
            }
        }
        return unknown;
    }

    /// That, or else the seeds' own.
    [[nodiscard]] std::int32_t bound_between(std::uint32_t a, std::uint32_t b) const {
        if (const std::int32_t barrier = barrier_between(a, b); barrier >= 0) {
            return barrier;
        }
        for (const std::uint32_t v : {a, b}) {
            const Vertex& vertex = model_.vertices[v];
            if (vertex.role == Role::seed &&
                is_bound(model_.barriers[static_cast<std::size_t>(vertex.owner)].sheet.kind)) {
                return vertex.owner;
            }
        }
        return unknown;
    }

    /// A cell of a vertex outside the extent is of the region that it hangs together with: of several, that which the
    /// fewest walls are between.
    void spread_regions() {
        const WallsOfCells walls = walls_of_cells(found_.complex, found_.region.size());
        std::vector<std::uint32_t> open;
        for (std::uint32_t cell = 0; cell < found_.region.size(); ++cell) {
            if (found_.region[cell] >= 0) {
                open.push_back(cell);
            }
        }
        for (std::size_t i = 0; i < open.size(); ++i) {
            for (const std::uint32_t w : walls.of(open[i])) {
                const VoronoiWall& wall = found_.complex.walls[w];
                if (wall.beyond < 0 || found_.barrier[w] >= 0) {
                    continue;
                }
                const auto beyond = static_cast<std::uint32_t>(wall.beyond);
                const std::uint32_t next = wall.cell == open[i] ? beyond : wall.cell;
                if (found_.region[next] < 0) {
                    found_.region[next] = found_.region[open[i]];
                    open.push_back(next);
                }
            }
        }
    }

    const Model& model_;
    const BarrierQuery& barriers_;
    std::vector<std::int32_t> region_;  ///< by vertex
    std::vector<std::int32_t> number_;  ///< of each vertex' cell
    VoronoiCells found_;
    std::vector<std::uint32_t> turned_;
};

}  // namespace

VoronoiCells voronoi_cells(const Model& model, const TetMesh& mesh, const CellRegions& regions,
                           const BarrierQuery& barriers, const Poll& poll) {
    VoronoiComplex complex = clipped_to(voronoi_dual(mesh, poll), model.domain.extent, poll);
    return CellFinder(model, mesh, regions, barriers).run(std::move(complex));
}

}  // namespace terratet
