// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/exact_volumes.hpp"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <numeric>

#include "interp/stolen_volumes.hpp"

namespace terratet {
namespace {

using Number = CGAL::Exact_rational;

struct ExactVector {
    Number x, y, z;
};

ExactVector operator+(const ExactVector& a, const ExactVector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
ExactVector operator-(const ExactVector& a, const ExactVector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
ExactVector operator*(const Number& s, const ExactVector& a) {
    return {s * a.x, s * a.y, s * a.z};
}
Number dot(const ExactVector& a, const ExactVector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
ExactVector cross(const ExactVector& a, const ExactVector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
ExactVector exact(const Vec3& p) {
    return {Number(p.x), Number(p.y), Number(p.z)};
}

/// The circle's centre as split: independent of rounded centres.
ExactVector split(const ExactVector& a, const ExactVector& b, const ExactVector& c) {
    return a + circle_center<ExactVector, Number>(b - a, c - a);
}

/// The cells' parts about the zone's vertices.
template <typename Point>
void add_cells(const CompactDelaunay& mesh, const Cavity& cavity, Point point, std::vector<Number>& volumes) {
    for (const std::int32_t id : cavity.all_cells(mesh)) {
        const auto& vertex = mesh.cells()[static_cast<std::size_t>(id)].vertex;
        const std::array<ExactVector, 4> p = {point(vertex[0]), point(vertex[1]), point(vertex[2]), point(vertex[3])};
        const ExactVector center =
            p[0] + BoundaryFacet<ExactVector, Number>(p[1] - p[0], p[2] - p[0], p[3] - p[0]).center;
        std::array<ExactVector, 4> splits;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto corner = [&](std::size_t i) { return p[static_cast<std::size_t>(facet_corners[k][i])]; };
            splits[k] = split(corner(0), corner(1), corner(2));
        }
        const auto parts = cell_parts<ExactVector, Number>(p, center, splits);
        for (std::size_t k = 0; k < 4; ++k) {
            volumes[cavity.number(vertex[k])] += parts[k];
        }
    }
}

}  // namespace

void exact_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q,
                  NaturalNeighbourOptions::Weighting weighting, std::vector<double>& shares) {
    const bool sibson = weighting == NaturalNeighbourOptions::Weighting::sibson;
    std::vector<Number> volumes(cavity.vertices.size(), Number(0));
    const auto point = [&](std::int32_t v) { return exact(mesh.points()[static_cast<std::size_t>(v)]) - exact(q); };
    if (sibson) {
        add_cells(mesh, cavity, point, volumes);
    }
    for (const auto& facet : cavity.facets) {
        const auto local = [&](std::size_t k) { return static_cast<std::size_t>(facet.vertex[k]); };
        const auto corner = [&](std::size_t k) { return point(cavity.vertices[local(k)]); };
        const ExactVector a = corner(0), b = corner(1), c = corner(2);
        const BoundaryFacet<ExactVector, Number> exact_facet(a, b, c);
        const auto more = sibson ? exact_facet.sibson(split(a, b, c)) : exact_facet.laplace();
        for (std::size_t k = 0; k < 3; ++k) {
            volumes[local(k)] += more[k];
        }
    }

    // Volumes are not negative, so rounding each before the sum costs no digits, where an exact sum would cost far more
    // than all the rest: its denominator is the product of theirs.
    shares.resize(volumes.size());
    std::transform(volumes.begin(), volumes.end(), shares.begin(), [](const Number& v) { return CGAL::to_double(v); });
    const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) {
        share /= total;
    }
}

std::array<double, 4> exact_barycentric(const std::array<Vec3, 4>& corners, const Vec3& q) {
    std::array<Number, 4> volumes;
    Number total = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto p = [&](int i) { return exact(corners[static_cast<std::size_t>(facet_corners[k][i])]) - exact(q); };
        volumes[k] = dot(p(0), cross(p(1), p(2)));
        total += volumes[k];
    }
    std::array<double, 4> coordinates{};
    std::transform(volumes.begin(), volumes.end(), coordinates.begin(),
                   [&](const Number& v) { return CGAL::to_double(Number(v / total)); });
    return coordinates;
}

}  // namespace terratet
