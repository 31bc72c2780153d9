// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/exact_volumes.hpp"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "interp/stolen_volumes.hpp"

namespace terratet {
namespace {

using Rational = CGAL::Exact_rational;

#if defined(__SIZEOF_FLOAT128__)
__extension__ using Wide = __float128;
#else
using Wide = long double;  // 113 bits where there is no __float128 (ARM, POWER)
#endif

double rounded(const Rational& number) {
    return CGAL::to_double(number);
}
double rounded(Wide number) {
    return static_cast<double>(number);
}

template <typename Number>
struct Vector {
    Number x, y, z;

    friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend Vector operator*(const Number& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
    friend Number dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
    friend Vector cross(const Vector& a, const Vector& b) {
        return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
};

/// p as seen from q; in rational numbers exact.
template <typename Number>
Vector<Number> relative(const Vec3& p, const Vec3& q) {
    return {Number(p.x) - Number(q.x), Number(p.y) - Number(q.y), Number(p.z) - Number(q.z)};
}

/// The circle's centre as split: independent of rounded centres.
template <typename Number>
Vector<Number> split(const Vector<Number>& a, const Vector<Number>& b, const Vector<Number>& c) {
    return a + circle_center<Vector<Number>, Number>(b - a, c - a);
}

/// The cells' parts about the zone's vertices.
template <typename Number, typename Point>
void add_cells(const CompactDelaunay& mesh, const Cavity& cavity, const Point& point, std::vector<Number>& volumes) {
    for (const std::int32_t id : cavity.all_cells(mesh)) {
        const auto& vertex = mesh.cells()[static_cast<std::size_t>(id)].vertex;
        const std::array<Vector<Number>, 4> p = {point(vertex[0]), point(vertex[1]), point(vertex[2]),
                                                 point(vertex[3])};
        const Vector<Number> center =
            p[0] + BoundaryFacet<Vector<Number>, Number>(p[1] - p[0], p[2] - p[0], p[3] - p[0]).center;
        std::array<Vector<Number>, 4> splits;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto corner = [&](std::size_t i) { return p[static_cast<std::size_t>(facet_corners[k][i])]; };
            splits[k] = split(corner(0), corner(1), corner(2));
        }
        const auto parts = cell_parts<Vector<Number>, Number>(p, center, splits);
        for (std::size_t k = 0; k < 4; ++k) {
            volumes[cavity.number(vertex[k])] += parts[k];
        }
    }
}

/// What each of the cavity's vertices loses to the query.
template <typename Number>
std::vector<Number> stolen(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q,
                           NaturalNeighbourOptions::Weighting weighting) {
    const bool sibson = weighting == NaturalNeighbourOptions::Weighting::sibson;
    std::vector<Number> volumes(cavity.vertices.size(), Number(0));
    const auto point = [&](std::int32_t v) { return relative<Number>(mesh.points()[static_cast<std::size_t>(v)], q); };
    if (sibson) {
        add_cells(mesh, cavity, point, volumes);
    }
    for (const auto& facet : cavity.facets) {
        const auto local = [&](std::size_t k) { return static_cast<std::size_t>(facet.vertex[k]); };
        const auto corner = [&](std::size_t k) { return point(cavity.vertices[local(k)]); };
        const Vector<Number> a = corner(0), b = corner(1), c = corner(2);
        const BoundaryFacet<Vector<Number>, Number> boundary(a, b, c);
        const auto more = sibson ? boundary.sibson(split(a, b, c)) : boundary.laplace();
        for (std::size_t k = 0; k < 3; ++k) {
            volumes[local(k)] += more[k];
        }
    }
    return volumes;
}

/// Volumes are not negative, so rounding each before the sum costs no digits, where an exact sum would cost far more
/// than all the rest: its denominator is the product of theirs.
template <typename Number>
void set_shares(const std::vector<Number>& volumes, std::vector<double>& shares) {
    shares.resize(volumes.size());
    std::transform(volumes.begin(), volumes.end(), shares.begin(), [](const Number& v) { return rounded(v); });
    const double total = std::accumulate(shares.begin(), shares.end(), 0.0);
    for (double& share : shares) {
        share /= total;
    }
}

constexpr double wide_tolerance = 1e-15;  // of Sibson's identity and of weights below 0

}  // namespace

void exact_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q,
                  NaturalNeighbourOptions::Weighting weighting, std::vector<double>& shares) {
    set_shares(stolen<Rational>(mesh, cavity, q, weighting), shares);
}

bool wide_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q,
                 NaturalNeighbourOptions::Weighting weighting, std::vector<double>& shares) {
    std::vector<Wide> volumes = stolen<Wide>(mesh, cavity, q, weighting);
    const Wide total = std::accumulate(volumes.begin(), volumes.end(), Wide(0));
    Vector<Wide> mean{0, 0, 0};
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t v = 0; v < volumes.size(); ++v) {
        if (!(volumes[v] >= Wide(-wide_tolerance) * total)) {
            return false;
        }
        const Vec3& site = mesh.points()[static_cast<std::size_t>(cavity.vertices[v])];
        mean = mean + (volumes[v] / total) * relative<Wide>(site, q);
        nearest = std::min(nearest, distance(site, q));
        volumes[v] = std::max(volumes[v], Wide(0));
    }
    if (!(rounded(dot(mean, mean)) <= wide_tolerance * wide_tolerance * nearest * nearest)) {
        return false;
    }
    set_shares(volumes, shares);
    return true;
}

std::array<double, 4> exact_barycentric(const std::array<Vec3, 4>& corners, const Vec3& q) {
    std::array<Rational, 4> volumes;
    Rational total = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto p = [&](int i) {
            return relative<Rational>(corners[static_cast<std::size_t>(facet_corners[k][i])], q);
        };
        volumes[k] = dot(p(0), cross(p(1), p(2)));
        total += volumes[k];
    }
    std::array<double, 4> coordinates{};
    std::transform(volumes.begin(), volumes.end(), coordinates.begin(),
                   [&](const Rational& v) { return CGAL::to_double(Rational(v / total)); });
    return coordinates;
}

}  // namespace terratet
