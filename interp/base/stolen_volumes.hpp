// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Sibson's and Laplace's weights from a conflict zone. One set of formulas for doubles, packs of doubles and exact
/// numbers: Vector has members x, y, z and operators and functions +, −, scalar *, dot, cross.
///
/// The bisectors of a cell's edges cut it into four parts, one about each vertex (signed where the circumcentre lies
/// outside): what the cell gives to the vertices' Voronoi cells. So what site a loses to a query is the sum of a's
/// parts of the cells of the zone, less those of the new cells that join the query to the zone's boundary. The former
/// do not depend on the query and are kept with each cell; the latter depend on one facet of the boundary each. Nothing
/// asks which cell of the zone lies beside which.

#include <array>
#include <cstddef>

#include "tess/base/tetrahedron.hpp"

namespace terratet {

/// From a to the centre of the circle through a, a + u and a + v; computed twice, the second time from what the first
/// left, since of a needle's centre only what makes it equidistant matters, and that is most of the error.
template <typename Vector, typename Number>
Vector circle_center(const Vector& u, const Vector& v) {
    const Vector n = cross(u, v);
    const Number scale = Number(1) / dot(n, n);
    const Vector along_u = scale * cross(v, n), along_v = scale * cross(n, u);
    const Number half_u = Number(0.5) * dot(u, u), half_v = Number(0.5) * dot(v, v);
    const Vector center = half_u * along_u + half_v * along_v;
    return center + (half_u - dot(center, u)) * along_u + (half_v - dot(center, v)) * along_v;
}

/// The volumes of a cell's four parts, times 12. \param center  of its circumsphere
/// \param splits  for each facet a point on its axis, the line of places equidistant to its three corners; there this
///     cell's parts end and the neighbour's begin. Each part is still as above, but for what neighbours exchange.
///
/// The part about a is bounded by faces through a, by a face on the bisector of each edge, and, where the split is off
/// the facet, by faces that the neighbour's part shares. With a as origin only the bisectors' count: for each facet and
/// each of its two edges a triangle (split × center)·(middle of the edge).
template <typename Vector, typename Number>
std::array<Number, 4> cell_parts(const std::array<Vector, 4>& p, const Vector& center,
                                 const std::array<Vector, 4>& splits) {
    std::array<Number, 4> parts{Number(0), Number(0), Number(0), Number(0)};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto corner = [&](std::size_t i) { return facet_corners[k][i % 3]; };
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector& a = p[corner(i)];
            parts[corner(i)] += dot(cross(center - a, splits[k] - a), p[corner(i + 1)] - p[corner(i + 2)]);
        }
    }
    return parts;
}

/// A facet abc of the zone's boundary, with the query at the origin and inside of it.
template <typename Vector, typename Number>
struct BoundaryFacet {
    Vector a, b, c;
    Vector normal_a, normal_b, normal_c;  ///< b × c and so on round: of the new cell's other facets
    Number aa, bb, cc, ab, bc, ca;        ///< their products
    Vector center;                        ///< g, of the sphere through the query, a, b and c
    Number ka, kb, kc;                    ///< kc = g·(a × b) / |a × b|²

    /// The centre is sought from the circle's: where the query is nearly coplanar with the facet only its distance from
    /// there is uncertain.
    BoundaryFacet(const Vector& pa, const Vector& pb, const Vector& pc) : a(pa), b(pb), c(pc) {
        normal_a = cross(b, c), normal_b = cross(c, a), normal_c = cross(a, b);
        aa = dot(a, a), bb = dot(b, b), cc = dot(c, c);
        ab = dot(a, b), bc = dot(b, c), ca = dot(c, a);
        const Vector from_a = circle_center<Vector, Number>(b - a, c - a);
        const Number rise = -(Number(0.5) * aa + dot(from_a, a)) / dot(a, normal_a);
        center = a + from_a + rise * (normal_a + normal_b + normal_c);
        ka = dot(center, normal_a) / dot(normal_a, normal_a);
        kb = dot(center, normal_b) / dot(normal_b, normal_b);
        kc = dot(center, normal_c) / dot(normal_c, normal_c);
    }

    /// What to add to the sums of a, b and c over the zone's cells, for Sibson's weights; times 12 as well.
    /// \param split  the facet's, relative to the query
    ///
    /// With the query as origin, what a loses has faces on the bisectors of its edges of the zone, which go on from the
    /// split to g (first term; second: for having taken a as the cells' origin), and one on its bisector with the
    /// query. They meet along the lines equidistant to a, b and the query, on which g lies k times a × b from the plane
    /// of the three; that gives a the last terms.
    [[nodiscard]] std::array<Number, 3> sibson(const Vector& split) const {
        const Vector x = cross(split, center);
        const Number xa = dot(x, a), xb = dot(x, b), xc = dot(x, c);
        const Number sa = dot(split, normal_a), sb = dot(split, normal_b), sc = dot(split, normal_c);
        const Number half(0.5);
        return {(xb - xc) - (sb + sc) + half * (kc * bb * (aa - ab) + kb * cc * (aa - ca)),
                (xc - xa) - (sc + sa) + half * (ka * cc * (bb - bc) + kc * aa * (bb - ab)),
                (xa - xb) - (sa + sb) + half * (kb * aa * (cc - ca) + ka * bb * (cc - bc))};
    }

    /// Its part of the area of the query's new Voronoi face with a, over |a|, and so on: Laplace's weights (Christ,
    /// Friedberg and Lee 1982). Times 4.
    [[nodiscard]] std::array<Number, 3> laplace() const {
        return {kc * (bb - ab) + kb * (cc - ca), ka * (cc - bc) + kc * (aa - ab), kb * (aa - ca) + ka * (bb - bc)};
    }
};

}  // namespace terratet
