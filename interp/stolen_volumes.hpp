// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Sibson's weights from a cavity: the volume that the query's Voronoi cell takes from each neighbour's. One formula
/// for doubles and for exact numbers: Vector has members x, y, z and operators and functions +, −, *, dot, cross.

#include <span>
#include <vector>

#include "interp/cavity.hpp"

namespace terratet {

/// Circumcentre of the origin, a, b and c, given their squared lengths.
template <typename Vector, typename Number>
Vector circumcenter_with_origin(const Vector& a, const Vector& b, const Vector& c, const Number& aa, const Number& bb,
                                const Number& cc) {
    const Vector bc = cross(b, c);
    const Number s = Number(0.5) / dot(a, bc);
    return s * (aa * bc + bb * cross(c, a) + cc * cross(a, b));
}

/// Fills volumes[v], in a common unit, for each vertex of the cavity. \param centers of its cells; both relative to the
/// query.
///
/// What a site a loses is a polyhedron: one face on the bisector of a and the query, and one on the bisector of a and b
/// for each edge ab of the cavity, with the circumcentres of the cells round that edge as corners. As each face's plane
/// has a known point, the polyhedron's volume is a sum over directed edges c₁c₂ of its faces of (c₁ × c₂)·point. Each
/// dual edge bounds the faces of the three edges of a facet abd; there x = c₁ × c₂ gives a the share x·b − x·d, and so
/// on round. Where the cavity ends, c₂ is the circumcentre g of the facet with the query, and the faces close along the
/// line of places equidistant to a, b and the query, on which g lies at g·(a × b); that adds
///     k |b|² a·(a − b) to a and k |a|² b·(b − a) to b,   k = g·(a × b) / 2|a × b|².
/// No pairs of neighbouring facets are needed, and the only divisions are by facets that the query is off the plane of.
template <typename Vector, typename Number>
void stolen_volumes(std::span<const Cavity::Cell> cells, std::span<const Vector> points,
                    std::span<const Vector> centers, std::vector<Number>& squared, std::vector<Number>& volumes) {
    squared.resize(points.size());
    for (std::size_t v = 0; v < points.size(); ++v) {
        squared[v] = dot(points[v], points[v]);
    }
    volumes.assign(points.size(), Number(0));

    const auto close_face = [&](std::size_t a, std::size_t b, const Vector& g) {
        const Vector normal = cross(points[a], points[b]);
        const Number ab = dot(points[a], points[b]);
        const Number k = dot(g, normal) / (Number(2) * dot(normal, normal));
        volumes[a] += k * squared[b] * (squared[a] - ab);
        volumes[b] += k * squared[a] * (squared[b] - ab);
    };

    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t other = cells[i].neighbour[k];
            if (other >= 0 && static_cast<std::size_t>(other) < i) {
                continue;  // done from the other side
            }
            const auto a = static_cast<std::size_t>(cells[i].vertex[facet_corners[k][0]]);
            const auto b = static_cast<std::size_t>(cells[i].vertex[facet_corners[k][1]]);
            const auto c = static_cast<std::size_t>(cells[i].vertex[facet_corners[k][2]]);
            Vector x;
            if (other >= 0) {
                x = cross(centers[i], centers[static_cast<std::size_t>(other)]);
            } else {
                const Vector g =
                    circumcenter_with_origin(points[a], points[b], points[c], squared[a], squared[b], squared[c]);
                close_face(a, b, g);
                close_face(b, c, g);
                close_face(c, a, g);
                x = cross(centers[i], g);
            }
            const Number xa = dot(x, points[a]), xb = dot(x, points[b]), xc = dot(x, points[c]);
            volumes[a] += xb - xc;
            volumes[b] += xc - xa;
            volumes[c] += xa - xb;
        }
    }
}

}  // namespace terratet
