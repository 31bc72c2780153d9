// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/exchange.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

namespace terratet {
namespace {

using delaunay::VertexHandle;

/// The next tables of vertices and values, and where each vertex goes.
struct Renumbering {
    ValuedVertices taken;
    ValuedVertices next;
    std::vector<std::uint32_t> new_index;
    std::vector<std::uint32_t> fresh;  ///< where in `next` the new ones are
};

Renumbering renumbered(const std::vector<Vertex>& vertices, const VertexValues& values,
                       const std::vector<std::uint64_t>& out, const ValuedVertices& in) {
    Renumbering r;
    r.new_index.assign(vertices.size(), no_index);
    const auto add_until = [&](std::uint64_t id) {
        for (std::size_t k = r.fresh.size(); k < in.vertices.size() && in.vertices[k].id < id; ++k) {
            r.fresh.push_back(static_cast<std::uint32_t>(r.next.vertices.size()));
            r.next.vertices.push_back(in.vertices[k]);
            append_row(in.values, k, r.next.values);
        }
    };
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        add_until(vertices[i].id);
        const bool leaves = std::ranges::binary_search(out, vertices[i].id);
        ValuedVertices& to = leaves ? r.taken : r.next;
        if (!leaves) {
            r.new_index[i] = static_cast<std::uint32_t>(r.next.vertices.size());
        }
        to.vertices.push_back(vertices[i]);
        append_row(values, i, to.values);
    }
    add_until(std::numeric_limits<std::uint64_t>::max());
    r.next.values.values.resize(values.values.size());
    assert(r.taken.vertices.size() == out.size());
    return r;
}

/// Those around a vertex that stay.
void add_neighbours(const delaunay::Triangulation& triangulation, VertexHandle of, std::vector<VertexHandle>& to) {
    if (triangulation.dimension() >= 1) {
        triangulation.finite_adjacent_vertices(of, std::back_inserter(to));
    }
}

}  // namespace

void append_row(const VertexValues& from, std::size_t i, VertexValues& to) {
    to.values.resize(from.values.size());
    for (std::size_t property = 0; property < from.values.size(); ++property) {
        to.values[property].push_back(from.values[property][i]);
    }
    to.extrapolation.push_back(from.extrapolation[i]);
}

ValuedVertices exchange(delaunay::Core& core, VertexValues& values, const std::vector<std::uint64_t>& out,
                        const ValuedVertices& in, std::vector<std::uint32_t>* touched) {
    auto& triangulation = core.triangulation;
    Renumbering r = renumbered(core.vertices, values, out, in);
    std::vector<VertexHandle> leaving;
    for (const auto handle : triangulation.finite_vertex_handles()) {
        handle->info() = r.new_index[handle->info()];
        if (handle->info() == no_index) {
            leaving.push_back(handle);
        }
    }
    std::vector<VertexHandle> near;
    for (const auto handle : leaving) {
        if (touched != nullptr) {
            add_neighbours(triangulation, handle, near);
        }
    }
    std::erase_if(near, [](VertexHandle handle) { return handle->info() == no_index; });
    for (const auto handle : leaving) {
        triangulation.remove(handle);
    }
    std::vector<VertexHandle> entered;
    for (std::size_t k = 0; k < in.vertices.size(); ++k) {
        const delaunay::Point point = delaunay::to_cgal(in.vertices[k].position);
        entered.push_back(entered.empty() ? triangulation.insert(point)
                                          : triangulation.insert(point, entered.back()->cell()));
        entered.back()->info() = r.fresh[k];
    }
    if (touched != nullptr) {
        for (const auto handle : entered) {
            near.push_back(handle);
            add_neighbours(triangulation, handle, near);
        }
        for (const auto handle : near) {
            touched->push_back(handle->info());
        }
        std::ranges::sort(*touched);
        touched->erase(std::ranges::unique(*touched).begin(), touched->end());
    }
    core.vertices = std::move(r.next.vertices);
    values = std::move(r.next.values);
    if (!core.vertices.empty()) {
        core.next_id = std::max(core.next_id, core.vertices.back().id + 1);
    }
    assert(triangulation.number_of_vertices() == core.vertices.size());
    return std::move(r.taken);
}

}  // namespace terratet
