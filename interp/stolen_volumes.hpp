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

/// A facet abc of the cavity's boundary, with the query at the origin.
template <typename Vector, typename Number>
struct BoundaryFacet {
    Vector center;  ///< of the sphere through the query, a, b and c
    Number a;       ///< what closing the faces of its three edges adds to the volumes of a, b and c
    Number b;
    Number c;

    BoundaryFacet(const Vector& pa, const Vector& pb, const Vector& pc, const Number& aa, const Number& bb,
                  const Number& cc) {
        const Vector na = cross(pb, pc), nb = cross(pc, pa), nc = cross(pa, pb);
        const Number half_inverse = Number(0.5) / dot(pa, na);
        center = half_inverse * (aa * na + bb * nb + cc * nc);
        const Number ab = dot(pa, pb), bc = dot(pb, pc), ca = dot(pc, pa);
        const Number ka = dot(center, na) / dot(na, na);
        const Number kb = dot(center, nb) / dot(nb, nb);
        const Number kc = dot(center, nc) / dot(nc, nc);
        a = Number(0.5) * (kc * bb * (aa - ab) + kb * cc * (aa - ca));
        b = Number(0.5) * (ka * cc * (bb - bc) + kc * aa * (bb - ab));
        c = Number(0.5) * (kb * aa * (cc - ca) + ka * bb * (cc - bc));
    }
};

/// Fills volumes[v], in a common unit, and squared[v], the squared length of points[v], for each vertex of the cavity.
/// \param points, centers  of the cavity's vertices and cells, relative to the query
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
                    std::span<const Vector> centers, std::span<Number> squared, std::span<Number> volumes) {
    for (std::size_t v = 0; v < points.size(); ++v) {
        squared[v] = dot(points[v], points[v]);
        volumes[v] = Number(0);
    }

    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (std::size_t k = 0; k < 4; ++k) {
            const std::int32_t other = cells[i].neighbour[k];
            if (other >= 0 && static_cast<std::size_t>(other) < i) {
                continue;  // done from the other side
            }
            const auto a = static_cast<std::size_t>(cells[i].vertex[facet_corners[k][0]]);
            const auto b = static_cast<std::size_t>(cells[i].vertex[facet_corners[k][1]]);
            const auto c = static_cast<std::size_t>(cells[i].vertex[facet_corners[k][2]]);
            const Vector pa = points[a], pb = points[b], pc = points[c];
            const auto add = [&](const Vector& x, const Number& to_a, const Number& to_b, const Number& to_c) {
                const Number xa = dot(x, pa), xb = dot(x, pb), xc = dot(x, pc);
                volumes[a] += to_a + (xb - xc);
                volumes[b] += to_b + (xc - xa);
                volumes[c] += to_c + (xa - xb);
            };
            if (other >= 0) {
                add(cross(centers[i], centers[static_cast<std::size_t>(other)]), Number(0), Number(0), Number(0));
            } else {
                const BoundaryFacet<Vector, Number> facet(pa, pb, pc, squared[a], squared[b], squared[c]);
                add(cross(centers[i], facet.center), facet.a, facet.b, facet.c);
            }
        }
    }
}

}  // namespace terratet
