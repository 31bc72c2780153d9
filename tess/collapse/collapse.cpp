// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/collapse.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "tess/barrier/query/model_bounds.hpp"
#include "tess/base/poll.hpp"
#include "tess/collapse/collapse_image.hpp"
#include "tess/collapse/collapse_mending.hpp"
#include "tess/collapse/node_splitter.hpp"
#include "tess/mesh/quality.hpp"

namespace terratet {
namespace {

using Corner = CollapseImage::Corner;
using Cell = CollapseImage::Cell;

constexpr double close_to_wall = 0.1;  ///< over the spacing

/// Joins what can be joined: where a cell would lose its volume, its seeds give up, until none does. Every round takes
/// something back for good, so it ends.
CollapseImage collapsed_image(const TetMesh& mesh, std::vector<FaultNode>& nodes, const Poll& poll) {
    for (;;) {
        ask(poll);
        CollapseImage image(mesh, nodes);
        ask(poll);
        image.remove_flat_cells();
        const std::vector<std::uint32_t> culprits = image.culprits();
        if (culprits.empty()) {
            return image;
        }
        for (const std::uint32_t node : culprits) {
            nodes[node].retreat();
        }
    }
}

/// Is what is left of a bound's gap beyond it? Close to a wall that is for the wall to say, not for the outline, from
/// which it may be a little off.
bool is_beyond(std::int32_t gap, const Vec3& p, const BarrierQuery& barriers, const Outline& outline) {
    const Barrier& bound = barriers.barriers()[static_cast<std::size_t>(gap)];
    const bool at_wall =
        bound.sheet.kind == SurfaceKind::domain && barriers.distance_to_sheet(gap, p) < close_to_wall * bound.spacing;
    return is_above_ground(barriers, p) || (at_wall ? barriers.side_of(gap, p) > 0 : !outline.contains(p));
}

CellStates cell_states(const Model& model, const CellTable& before, const std::vector<char>& selected,
                       const CollapseImage& image, const Poll& poll) {
    const BarrierQuery barriers(model.barriers);
    PatientPoll go_on(poll);
    const Outline outline(model.domain.outline);
    CellStates states;
    for (const Cell& cell : image.cells()) {
        go_on();
        Vec3 sum;
        for (const Corner& corner : cell.corners) {
            sum = sum + image.position(corner.node);
        }
        const Vec3 centroid = 0.25 * sum;
        const std::int32_t gap = before.barrier[cell.parent];
        const bool bound = gap >= 0 && is_bound(model.barriers[static_cast<std::size_t>(gap)].sheet.kind);
        const bool collapsed = gap >= 0 && selected[static_cast<std::size_t>(gap)] != 0;
        const bool beyond = bound ? is_beyond(gap, centroid, barriers, outline) : before.beyond[cell.parent] != 0;
        states.barrier.push_back(collapsed ? -1 : gap);
        states.beyond.push_back(beyond ? 1 : 0);
        states.in_extent.push_back(!beyond && model.domain.extent.contains(centroid) ? 1 : 0);
        states.region.push_back(cell.made ? -1 : before.region[cell.parent]);
    }
    return states;
}

/// The mean in the property's scale; of a category the first value. Missing values do not count.
double mean(const Property& property, const std::vector<double>& values, const std::vector<std::uint32_t>& vertices) {
    if (vertices.size() == 1) {
        return values[vertices[0]];
    }
    double sum = 0;
    int count = 0;
    for (const std::uint32_t v : vertices) {
        if (std::isnan(values[v])) {
            continue;
        }
        if (property.kind == Kind::categorical) {
            return values[v];
        }
        sum += to_scale(property, values[v]);
        ++count;
    }
    return count == 0 ? missing : from_scale(property, sum / count);
}

/// Nodes as vertices, with their values.
void fill_vertices(const Model& model, const CollapseImage& image, const std::vector<NodePart>& parts,
                   CollapsedModel& result) {
    result.model.vertices.clear();
    result.model.vertex_values = {};
    result.model.vertex_values.values.resize(model.properties.size());
    std::uint64_t next_id = model.vertices.empty() ? 0 : model.vertices.back().id + 1;
    std::set<std::uint32_t> taken;
    for (const NodePart& part : parts) {
        Vertex vertex = model.vertices[part.vertices.front()];
        for (const std::uint32_t v : part.vertices) {
            const Vertex& other = model.vertices[v];
            if (other.owner == vertex.owner && other.side != vertex.side) {
                vertex.side = 0;
            }
        }
        if (part.node >= model.vertices.size() || !taken.insert(part.vertices.front()).second) {
            vertex.id = next_id++;
        }
        vertex.position = image.position(part.node);
        result.mesh.points.push_back(vertex.position);
        result.model.vertices.push_back(vertex);
        for (std::size_t p = 0; p < model.properties.size(); ++p) {
            result.model.vertex_values.values[p].push_back(
                mean(model.properties[p], model.vertex_values.values[p], part.vertices));
        }
        result.model.vertex_values.extrapolation.push_back(mean({}, model.vertex_values.extrapolation, part.vertices));
    }
}

void fill_cells(const CellTable& before, const CollapseImage& image, CellStates states, CollapsedModel& result) {
    CellTable& table = result.cells;
    const TetMesh& mesh = result.mesh;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const auto& v = mesh.cells[c];
        const CellQuality quality =
            cell_quality({mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]});
        table.reason.push_back(before.reason[image.cells()[c].parent]);
        table.radius_edge.push_back(static_cast<float>(quality.radius_edge));
        table.aspect.push_back(static_cast<float>(quality.aspect));
        table.dihedral_min_deg.push_back(static_cast<float>(quality.dihedral_min_deg));
    }
    table.barrier = std::move(states.barrier);
    table.beyond = std::move(states.beyond);
    table.in_extent = std::move(states.in_extent);
    table.region_count = before.region_count;
    table.region_name = before.region_name;
}

/// Seeds of exact faults without width stand beside these; nodes of cuts may slide along them. By part.
std::vector<char> loose_nodes(const Model& model, const std::vector<char>& selected, const CollapseImage& image,
                              const std::vector<NodePart>& parts) {
    std::vector<char> loose;
    for (const NodePart& part : parts) {
        const bool free = std::ranges::all_of(part.vertices, [&](std::uint32_t v) {
            return model.vertices[v].role == Role::seed &&
                   selected[static_cast<std::size_t>(model.vertices[v].owner)] != 0;
        });
        loose.push_back(free && image.fault_nodes_at(part.node).empty() ? 1 : 0);
    }
    return loose;
}

template <class T>
void keep(std::vector<T>& column, const std::vector<char>& kept) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < column.size(); ++i) {
        if (kept[i] != 0) {
            column[next++] = column[i];
        }
    }
    column.resize(next);
}

/// The cells above the ground and outside the outline, and the nodes that only they have, are taken out.
void drop_beyond(CollapsedModel& result) {
    CellTable& table = result.cells;
    TetMesh& mesh = result.mesh;
    std::vector<char> kept_cell;
    std::vector<std::int32_t> cell_number;
    std::vector<char> kept_node(mesh.points.size(), 0);
    std::int32_t cells = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        kept_cell.push_back(table.beyond[c] == 0 ? 1 : 0);
        cell_number.push_back(table.beyond[c] == 0 ? cells++ : -1);
        for (const std::uint32_t node : mesh.cells[c]) {
            kept_node[node] = kept_node[node] != 0 || table.beyond[c] == 0 ? 1 : 0;
        }
    }
    std::vector<std::uint32_t> node_number;
    std::uint32_t nodes = 0;
    for (const char kept : kept_node) {
        node_number.push_back(nodes);
        nodes += kept != 0 ? 1 : 0;
    }
    keep(mesh.points, kept_node);
    keep(result.model.vertices, kept_node);
    for (std::vector<double>& values : result.model.vertex_values.values) {
        keep(values, kept_node);
    }
    keep(result.model.vertex_values.extrapolation, kept_node);
    keep(mesh.cells, kept_cell);
    keep(mesh.neighbours, kept_cell);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        for (std::size_t k = 0; k < 4; ++k) {
            mesh.cells[c][k] = node_number[mesh.cells[c][k]];
            const std::int32_t beyond = mesh.neighbours[c][k];
            mesh.neighbours[c][k] = beyond < 0 ? -1 : cell_number[static_cast<std::size_t>(beyond)];
        }
    }
    keep(table.region, kept_cell);
    keep(table.barrier, kept_cell);
    keep(table.in_extent, kept_cell);
    keep(table.reason, kept_cell);
    keep(table.radius_edge, kept_cell);
    keep(table.aspect, kept_cell);
    keep(table.dihedral_min_deg, kept_cell);
    keep(table.beyond, kept_cell);
}

}  // namespace

bool has_bounds(const Model& model) {
    return std::ranges::any_of(model.barriers, [](const Barrier& barrier) { return is_bound(barrier.sheet.kind); });
}

CollapsedModel collapse_faults(const Model& model, const TetMesh& mesh, const CellTable& cells, Collapsing which,
                               const Progress& progress) {
    return collapse_faults(model, mesh, cells, model_proximity(model), which, progress);
}

CollapsedModel collapse_faults(const Model& model, const TetMesh& mesh, const CellTable& cells,
                               const BarrierQuery& barriers, Collapsing which, const Progress& progress) {
    double done = 0;
    const Poll poll = [&] { report_progress(progress, "collapse faults", done); };
    const auto reached = [&](double share) {
        done = share;
        poll();
    };
    reached(0);
    std::vector<char> selected;
    for (const Barrier& barrier : model.barriers) {
        selected.push_back(which == Collapsing::all || is_bound(barrier.sheet.kind) ? 1 : 0);
    }
    std::vector<FaultNode> nodes = fault_nodes(model, mesh, selected, poll);
    reached(0.2);
    CollapseImage image = collapsed_image(mesh, nodes, poll);
    reached(0.4);
    const bool exact = model.barrier_options.mode == SeedMode::exact;
    const std::vector<Vec3> uncut = exact ? image.cut_edges(model, selected, poll) : std::vector<Vec3>{};
    reached(0.6);
    CellStates states = cell_states(model, cells, selected, image, poll);
    SplitImage split = split_nodes(model, selected, image, nodes, states, poll);
    reached(0.9);

    CollapsedModel result{model, {}, {}, {}};
    fill_vertices(model, image, split.parts, result);
    result.mesh.cells = std::move(split.cells);
    result.mesh.neighbours = std::move(split.neighbours);
    result.cells.region = std::move(split.regions);
    fill_cells(cells, image, std::move(states), result);
    if (std::ranges::any_of(cells.barrier, [](std::int32_t barrier) { return barrier >= 0; })) {
        reached(1);
        mend_collapsed(
            result, barriers,
            exact ? loose_nodes(model, selected, image, split.parts) : std::vector<char>(split.parts.size(), 0),
            progress);  // else nothing was cut
    }

    CollapseReport& report = result.report;
    report.dropped_cells = static_cast<std::size_t>(std::ranges::count_if(
                               cells.barrier, [](std::int32_t barrier) { return barrier >= 0; })) -
                           static_cast<std::size_t>(std::ranges::count_if(image.cells(), [&](const Cell& cell) {
                               return !cell.made && cells.barrier[cell.parent] >= 0;
                           }));
    report.added_places = image.added_nodes();
    report.split_places = split.split_places;
    report.split_area = split.split_area;
    for (const FaultNode& node : nodes) {
        if (node.is_vertex() || node.state == FaultNode::State::joined || !model.domain.extent.contains(node.base)) {
            continue;
        }
        const std::int32_t barrier = model.vertices[node.seeds[0]].owner;
        const double spacing = model.barriers[static_cast<std::size_t>(barrier)].spacing;
        if (barriers.distance_to_sheet(barrier, node.base) < 1e-3 * spacing) {
            (node.state == FaultNode::State::apart ? report.apart : report.aside).push_back(node.base);
        }
    }
    for (std::size_t f = 0; f < model.barriers.size(); ++f) {
        report.sheet_area += selected[f] != 0 ? statistics(model.barriers[f].sheet).area : 0;
    }
    if (exact) {
        std::ranges::copy_if(uncut, std::back_inserter(report.aside),
                             [&](const Vec3& p) { return model.domain.extent.contains(p); });
        std::ranges::copy(split.off_barriers_of, std::back_inserter(report.aside));
    }
    report.conformity = check_conformity(result.mesh, result.cells.region, model.domain.hull);
    drop_beyond(result);
    return result;
}

}  // namespace terratet
