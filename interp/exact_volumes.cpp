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

}  // namespace

void exact_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, std::vector<double>& shares) {
    std::vector<ExactVector> points;
    for (const std::int32_t v : cavity.vertices) {
        points.push_back(exact(mesh.points()[static_cast<std::size_t>(v)]) - exact(q));
    }
    std::vector<ExactVector> centers;
    for (const auto& cell : cavity.cells) {
        const auto p = [&](std::size_t k) { return points[static_cast<std::size_t>(cell.vertex[k])]; };
        const ExactVector a = p(1) - p(0), b = p(2) - p(0), c = p(3) - p(0);
        centers.push_back(p(0) + BoundaryFacet<ExactVector, Number>(a, b, c, dot(a, a), dot(b, b), dot(c, c)).center);
    }
    std::vector<Number> squared(points.size());
    std::vector<Number> volumes(points.size());
    stolen_volumes<ExactVector, Number>(cavity.cells, points, centers, squared, volumes);

    // Volumes are not negative, so rounding each before the sum costs no digits, where an exact sum would cost far more
    // than all the rest: its denominator is the product of theirs.
    shares.resize(volumes.size());
    std::transform(volumes.begin(), volumes.end(), shares.begin(), [](const Number& v) { return CGAL::to_double(v); });
    const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) {
        share /= total;
    }
}

}  // namespace terratet
