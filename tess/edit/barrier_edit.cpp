// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/barrier_edit.hpp"

#include <algorithm>
#include <cassert>
#include <set>

#include "tess/mesh/delaunay.hpp"

namespace terratet {
namespace {

/// Row i of the values, appended to others.
void append_row(const VertexValues& from, std::size_t i, VertexValues& to) {
    to.values.resize(from.values.size());
    for (std::size_t property = 0; property < from.values.size(); ++property) {
        to.values[property].push_back(from.values[property][i]);
    }
    to.extrapolation.push_back(from.extrapolation[i]);
}

/// Takes out the vertices with the given ids and puts in others; both ascend. Returns what was taken out.
ValuedVertices exchange(delaunay::Core& core, VertexValues& values, const std::vector<std::uint64_t>& out,
                        const ValuedVertices& in) {
    ValuedVertices taken;
    ValuedVertices next;
    std::vector<std::uint32_t> new_index(core.vertices.size(), delaunay::none);
    std::vector<std::pair<delaunay::Point, std::uint32_t>> points;
    const auto add_until = [&](std::uint64_t id) {
        for (std::size_t k = points.size(); k < in.vertices.size() && in.vertices[k].id < id; ++k) {
            points.emplace_back(delaunay::to_cgal(in.vertices[k].position),
                                static_cast<std::uint32_t>(next.vertices.size()));
            next.vertices.push_back(in.vertices[k]);
            append_row(in.values, k, next.values);
        }
    };
    for (std::size_t i = 0; i < core.vertices.size(); ++i) {
        const Vertex& vertex = core.vertices[i];
        add_until(vertex.id);
        const bool leaves = std::ranges::binary_search(out, vertex.id);
        ValuedVertices& to = leaves ? taken : next;
        if (!leaves) {
            new_index[i] = static_cast<std::uint32_t>(next.vertices.size());
        }
        to.vertices.push_back(vertex);
        append_row(values, i, to.values);
    }
    add_until(std::numeric_limits<std::uint64_t>::max());
    assert(taken.vertices.size() == out.size());

    std::vector<delaunay::VertexHandle> leaving;
    for (const auto handle : core.triangulation.finite_vertex_handles()) {
        handle->info() = new_index[handle->info()];
        if (handle->info() == delaunay::none) {
            leaving.push_back(handle);
        }
    }
    for (const auto handle : leaving) {
        core.triangulation.remove(handle);
    }
    core.triangulation.insert(points.begin(), points.end());
    next.values.values.resize(values.values.size());
    core.vertices = std::move(next.vertices);
    values = std::move(next.values);
    if (!core.vertices.empty()) {
        core.next_id = std::max(core.next_id, core.vertices.back().id + 1);
    }
    assert(core.triangulation.number_of_vertices() == core.vertices.size());
    return taken;
}

/// The seeds that find a place, with ids above all others.
ValuedVertices placed_seeds(const Tessellation& tessellation, const std::vector<std::uint64_t>& leaving,
                            const Domain& domain, const Barrier& barrier, std::int32_t owner,
                            const ValueSource& source) {
    Box3 around;
    for (const Seed& seed : barrier.seeds) {
        around.extend(seed.position);
    }
    std::set<Vec3> taken;
    for (const Vertex& vertex : tessellation.vertices()) {
        if (around.contains(vertex.position) && !std::ranges::binary_search(leaving, vertex.id)) {
            taken.insert(vertex.position);
        }
    }
    ValuedVertices result;
    std::vector<ValueQuery> queries;
    for (const Seed& seed : barrier.seeds) {
        if (domain.hull.contains(seed.position) && taken.insert(seed.position).second) {
            const std::uint64_t id = tessellation.next_id() + result.vertices.size();
            result.vertices.push_back({id, seed.position, Role::seed, owner, seed.side});
            queries.push_back({seed.position, owner, seed.side});
        }
    }
    ValueBatch batch = source(queries);
    result.values = {std::move(batch.values), std::move(batch.extrapolation)};
    return result;
}

}  // namespace

BarrierChange insert_barrier(Tessellation& tessellation, VertexValues& values, const Domain& domain,
                             const Barrier& barrier, std::int32_t number, const ValueSource& source) {
    const BarrierQuery zone({&barrier, 1});
    std::vector<std::uint64_t> leaving;
    for (const Vertex& vertex : tessellation.vertices()) {
        if ((vertex.role == Role::sample || vertex.role == Role::inserted) &&
            zone.protecting_barrier(vertex.position) >= 0) {
            leaving.push_back(vertex.id);
        }
    }
    const ValuedVertices seeds = placed_seeds(tessellation, leaving, domain, barrier, number, source);
    BarrierChange change;
    for (const Vertex& seed : seeds.vertices) {
        change.ids.push_back(seed.id);
    }
    change.removed = exchange(delaunay::core(tessellation), values, leaving, seeds);
    return change;
}

void take_out_barrier(Tessellation& tessellation, VertexValues& values, const BarrierChange& change) {
    exchange(delaunay::core(tessellation), values, change.ids, change.removed);
}

}  // namespace terratet
