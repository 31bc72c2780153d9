// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/barrier_edit.hpp"

#include <algorithm>
#include <set>

#include "tess/mesh/delaunay.hpp"

namespace terratet {
namespace {

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
