// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/refine/live_vertices.hpp"

#include <algorithm>

#include "tess/refine/beyond_limit.hpp"

namespace terratet {

namespace {

constexpr std::size_t batch_size = 1U << 12U;  ///< enough for any number of threads

}  // namespace

LiveVertices::LiveVertices(delaunay::Core& core, VertexValues& values, const ValueSource& source, bool values_at_once,
                           std::uint64_t max_vertices, double l_min, double bound)
    : core_(core),
      values_(values),
      source_(source),
      values_at_once_(values_at_once),
      max_vertices_(max_vertices),
      others_(core.vertices.size()),
      l_min_(l_min),
      bound_(bound) {}

std::uint32_t LiveVertices::append(const Vec3& place, const Estimate* known) {
    auto& vertices = core_.vertices;
    if (vertices.size() >= max_vertices_) {
        throw refinement_beyond(max_vertices_, others_, l_min_, bound_);
    }
    if (vertices.size() == vertices.capacity()) {  // doubling would cost more than the queue
        vertices.reserve(vertices.size() / 8 * 9 + 8);
    }
    vertices.push_back({core_.next_id++, place, Role::inserted, -1, 0});
    if (known != nullptr) {
        for (std::size_t p = 0; p < values_.values.size(); ++p) {
            values_.values[p].push_back(known->values[p]);
        }
        values_.extrapolation.push_back(known->extrapolation);
    } else if (values_at_once_) {
        complete();
    }
    return static_cast<std::uint32_t>(vertices.size() - 1);
}

void LiveVertices::pop() {
    core_.vertices.pop_back();
    --core_.next_id;
    if (valued() > size()) {
        for (auto& column : values_.values) {
            column.pop_back();
        }
        values_.extrapolation.pop_back();
    }
}

void LiveVertices::revalue(std::uint32_t vertex, const Vec3& place) {
    if (vertex >= valued()) {
        return;
    }
    const ValueQuery query{place, -1, 0};
    const ValueBatch batch = source_({&query, 1});
    ++asked_;
    for (std::size_t p = 0; p < values_.values.size(); ++p) {
        values_.values[p][vertex] = batch.values[p][0];
    }
    values_.extrapolation[vertex] = batch.extrapolation[0];
}

void LiveVertices::drop(const std::vector<std::uint32_t>& removed) {
    if (removed.empty()) {
        return;
    }
    std::vector<std::uint32_t> new_index(size(), 0);
    for (const std::uint32_t vertex : removed) {
        new_index[vertex] = no_index;
    }
    const auto compact = [&](auto& column) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < column.size(); ++i) {
            if (new_index[i] != no_index) {
                column[kept++] = column[i];
            }
        }
        column.resize(kept);
    };
    for (auto& column : values_.values) {
        compact(column);
    }
    compact(values_.extrapolation);
    compact(core_.vertices);
    std::uint32_t next = 0;
    for (std::uint32_t& index : new_index) {
        index = index == no_index ? no_index : next++;
    }
    for (const auto vertex : core_.triangulation.finite_vertex_handles()) {
        vertex->info() = new_index[vertex->info()];
    }
}

void LiveVertices::complete() {
    if (valued() == size()) {
        return;
    }
    if (size() - valued() > batch_size) {  // exactly: growing by halves would cost more than the batches
        for (auto& column : values_.values) {
            column.reserve(size());
        }
        values_.extrapolation.reserve(size());
    }
    std::vector<ValueQuery> queries;
    while (valued() < size()) {
        queries.clear();
        for (std::size_t i = valued(); i < std::min(size(), valued() + batch_size); ++i) {
            queries.push_back({core_.vertices[i].position, -1, 0});
        }
        const ValueBatch batch = source_(queries);
        asked_ += queries.size();
        for (std::size_t p = 0; p < values_.values.size(); ++p) {
            values_.values[p].insert(values_.values[p].end(), batch.values[p].begin(), batch.values[p].end());
        }
        values_.extrapolation.insert(values_.extrapolation.end(), batch.extrapolation.begin(),
                                     batch.extrapolation.end());
    }
}

}  // namespace terratet
