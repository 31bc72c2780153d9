// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// What a clipped mesh's points are, and which values they have.

#include <cmath>

#include "io/write/clipped_parts.hpp"
#include "io/write/view_barriers.hpp"

namespace terratet {
namespace {

/// Vertices of all places. A cut keeps the role and side that its ends share.
std::vector<Vertex> place_vertices(const ClippedMesh& mesh, const Model& model) {
    std::vector<Vertex> vertices = model.vertices;
    for (const auto& [a, b, t] : mesh.cuts) {
        const Vertex& near = vertices[t <= 0.5 ? a : b];
        const Vertex& far = vertices[t <= 0.5 ? b : a];
        const bool along = near.side != 0 && far.side != 0 && near.owner == far.owner;  // both of one fault
        Vertex cut;
        cut.role = Role::domain;
        cut.owner = along ? near.owner : -1;
        cut.side = along ? near.side : std::int8_t{0};
        vertices.push_back(cut);
    }
    for (const ClippedMesh::Moved& moved : mesh.moved) {
        Vertex vertex;
        vertex.role = moved.on_face ? Role::domain : Role::inserted;
        vertices.push_back(vertex);
    }
    return vertices;
}

/// \param mix of two values and the second's share
template <class Mix>
std::vector<double> at_points(const ClippedMesh& mesh, std::vector<double> values, Mix&& mix) {
    for (const auto& [a, b, t] : mesh.cuts) {
        values.push_back(t <= 0 ? values[a] : t >= 1 ? values[b] : mix(values[a], values[b], t));
    }
    for (const ClippedMesh::Moved& moved : mesh.moved) {
        values.push_back(blended(moved.blend, values, mix));
    }
    std::vector<double> result;
    result.reserve(mesh.place.size());
    for (const auto place : mesh.place) {
        result.push_back(values[place]);
    }
    return result;
}

double linear_mix(double a, double b, double t) {
    return a + t * (b - a);
}

}  // namespace

void keep_to_own_sides(const ModelView& view, std::span<const Vec3> points, std::vector<ClippedMesh::Cut>& cuts) {
    const Model& model = view.model;
    const ViewBarriers faults(view);
    ClippedMesh so_far;
    so_far.cuts = std::move(cuts);
    const std::vector<Vertex> vertices = place_vertices(so_far, model);
    cuts = std::move(so_far.cuts);
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        auto& [a, b, t] = cuts[i];
        const Vec3& p = points[model.vertices.size() + i];
        const bool of_one = vertices[a].side != 0 && vertices[b].side != 0 && vertices[a].owner == vertices[b].owner;
        if (of_one && vertices[a].side == vertices[b].side) {
            continue;  // along a sheet
        }
        const bool a_hidden = of_one ? t > 0.5 : is_hidden(*faults, p, points[a]);
        const bool b_hidden = of_one ? t <= 0.5 : is_hidden(*faults, p, points[b]);
        if (a_hidden || b_hidden) {
            t = a_hidden && b_hidden ? std::round(t) : a_hidden ? 1 : 0;
        }
    }
}

std::vector<double> ClippedMesh::values(const Model& model, std::size_t property) const {
    const Property& p = model.properties[property];
    return at_points(*this, model.vertex_values.values[property], [&](double a, double b, double t) {
        if (a == b || p.kind == Kind::categorical) {
            return t <= 0.5 ? a : b;
        }
        return from_scale(p, linear_mix(to_scale(p, a), to_scale(p, b), t));
    });
}

std::vector<double> ClippedMesh::extrapolation(const Model& model) const {
    return at_points(*this, model.vertex_values.extrapolation, linear_mix);
}

std::vector<Vertex> ClippedMesh::vertices(const Model& model) const {
    const std::vector<Vertex> all = place_vertices(*this, model);
    std::vector<Vertex> result;
    result.reserve(place.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        result.push_back(all[place[i]]);
        result.back().position = points[i];
    }
    return result;
}

}  // namespace terratet
