// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/collapse/collapse_mending.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tess/base/poll.hpp"
#include "tess/collapse/facet_neighbours.hpp"
#include "tess/mending/blend.hpp"
#include "tess/mending/mend_cells.hpp"
#include "tess/mesh/quality.hpp"

namespace terratet {
namespace {

constexpr double wanted_edge = 0.3;  ///< over l_min
constexpr std::int32_t beyond = -2;

std::vector<MendableMesh::Hold> holds(const CollapsedModel& collapsed, std::span<const char> loose) {
    std::vector<MendableMesh::Hold> result;
    for (std::size_t v = 0; v < loose.size(); ++v) {
        const Role role = collapsed.model.vertices[v].role;
        const bool stays = role == Role::sample || (role == Role::seed && loose[v] == 0);
        result.push_back(stays ? MendableMesh::Hold::fixed : MendableMesh::Hold::free);
    }
    return result;
}

/// Facets on faults whose two sides share all three nodes, as where these are on a rim: their cells' corners alone
/// would not tell that they are there.
std::vector<Triangle> shared_facets(const TetMesh& mesh) {
    std::vector<Triangle> single;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        for (std::size_t k = 0; k < 4; ++k) {
            if (mesh.neighbours[c][k] < 0) {
                single.push_back(ascending_facet(mesh.cells[c], k));
            }
        }
    }
    std::ranges::sort(single);
    std::vector<Triangle> result;
    for (std::size_t i = 0; i + 1 < single.size(); ++i) {
        if (single[i] == single[i + 1]) {
            result.push_back(single[i]);
        }
    }
    return result;
}

MendableMesh cut_mesh(const CollapsedModel& collapsed, std::span<const char> loose) {
    MendableMesh result;
    result.walls = shared_facets(collapsed.mesh);
    result.box = collapsed.model.domain.hull;
    result.least_edge = wanted_edge * collapsed.model.criteria.l_min;
    result.points = collapsed.mesh.points;
    result.hold = holds(collapsed, loose);
    const CellTable& table = collapsed.cells;
    for (std::uint32_t c = 0; c < collapsed.mesh.cells.size(); ++c) {
        const bool is_beyond = table.beyond[c] != 0;
        const bool is_gap = table.barrier[c] >= 0;
        const std::int32_t part = is_beyond ? beyond : is_gap ? beyond - 1 - table.barrier[c] : table.region[c];
        result.cells.push_back({collapsed.mesh.cells[c], c, part, !is_beyond && !is_gap, false});
    }
    return result;
}

/// \param near of each point, a cell of the mesh before
void take_points(const MendableMesh& mended, const std::vector<std::uint32_t>& near, const BarrierQuery& barriers,
                 const Poll& poll, CollapsedModel& collapsed) {
    PatientPoll go_on(poll);
    Model& model = collapsed.model;
    std::uint64_t next_id = 0;
    for (const Vertex& vertex : model.vertices) {
        next_id = std::max(next_id, vertex.id + 1);
    }
    const OwnSideField field(collapsed.mesh, collapsed.cells.barrier, barriers);
    const VertexValues before = model.vertex_values;
    for (std::size_t v = 0; v < mended.points.size(); ++v) {
        go_on();
        if (mended.moved[v] == 0 || near[v] == no_index) {
            continue;
        }
        const Blend blend = field.at(mended.points[v], near[v]);
        for (std::size_t p = 0; p < model.properties.size(); ++p) {
            const Property& property = model.properties[p];
            model.vertex_values.values[p][v] = blended(blend, before.values[p], [&](double a, double b, double t) {
                if (a == b || property.kind == Kind::categorical) {
                    return t <= 0.5 ? a : b;
                }
                return from_scale(property, std::lerp(to_scale(property, a), to_scale(property, b), t));
            });
        }
        model.vertex_values.extrapolation[v] =
            blended(blend, before.extrapolation, [](double a, double b, double t) { return std::lerp(a, b, t); });
        model.vertices[v] = {next_id++, mended.points[v], Role::inserted, -1, 0};
    }
    collapsed.mesh.points = mended.points;
}

template <class T>
void gather(std::vector<T>& column, const std::vector<MendableMesh::Cell>& cells) {
    std::vector<T> result;
    result.reserve(cells.size());
    for (const MendableMesh::Cell& cell : cells) {
        result.push_back(column[cell.parent]);
    }
    column = std::move(result);
}

void take_cells(const std::vector<MendableMesh::Cell>& cells, const std::vector<Triangle>& walls,
                CollapsedModel& collapsed) {
    CellTable& table = collapsed.cells;
    gather(table.region, cells);
    gather(table.barrier, cells);
    gather(table.beyond, cells);
    gather(table.in_extent, cells);
    gather(table.reason, cells);
    gather(table.radius_edge, cells);
    gather(table.aspect, cells);
    gather(table.dihedral_min_deg, cells);
    collapsed.mesh.cells.clear();
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const Corners& v = cells[c].corners;
        collapsed.mesh.cells.push_back(v);
        if (!cells[c].touched) {
            continue;
        }
        const auto& points = collapsed.mesh.points;
        const CellQuality quality = cell_quality({points[v[0]], points[v[1]], points[v[2]], points[v[3]]});
        table.radius_edge[c] = static_cast<float>(quality.radius_edge);
        table.aspect[c] = static_cast<float>(quality.aspect);
        table.dihedral_min_deg[c] = static_cast<float>(quality.dihedral_min_deg);
    }
    collapsed.mesh.neighbours = neighbours_of(collapsed.mesh.cells);
    for (std::size_t c = 0; c < cells.size() && !walls.empty(); ++c) {
        for (std::size_t k = 0; k < 4; ++k) {
            if (std::ranges::binary_search(walls, ascending_facet(cells[c].corners, k))) {
                collapsed.mesh.neighbours[c][k] = -1;
            }
        }
    }
}

}  // namespace

void mend_collapsed(CollapsedModel& collapsed, const BarrierQuery& barriers, std::span<const char> loose,
                    const Progress& progress) {
    MendableMesh mended = cut_mesh(collapsed, loose);
    mend_cells(mended, progress);
    const Poll poll = [&] { report_progress(progress, "mend cells", 1); };
    poll();
    std::erase_if(mended.cells, [](const MendableMesh::Cell& cell) { return MendableStars::gone(cell); });
    std::ranges::stable_sort(mended.cells, {}, &MendableMesh::Cell::parent);
    std::vector<std::uint32_t> near(mended.points.size(), no_index);
    for (const MendableMesh::Cell& cell : mended.cells) {
        for (const std::uint32_t v : cell.corners) {
            near[v] = std::min(near[v], cell.parent);
        }
    }
    take_points(mended, near, barriers, poll, collapsed);
    poll();
    take_cells(mended.cells, mended.walls, collapsed);
}

}  // namespace terratet
