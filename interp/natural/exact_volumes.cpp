// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/exact_volumes.hpp"

#include <CGAL/Exact_rational.h>

#include <algorithm>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "interp/base/stolen_volumes.hpp"
#include "interp/sites/sphere_tree.hpp"
#include "tess/base/circumsphere.hpp"
#include "tess/base/wide.hpp"

namespace terratet {
namespace {

using Rational = CGAL::Exact_rational;

/// Of fixed size: a sum of a thousand terms is as long as each.
template <unsigned bits>
using Precise =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<bits, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

double rounded(long double number) {
    return static_cast<double>(number);
}
#if defined(__SIZEOF_FLOAT128__)
double rounded(Wide number) {
    return static_cast<double>(number);
}
#endif
template <unsigned bits>
double rounded(const Precise<bits>& number) {
    return number.template convert_to<double>();
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
template <typename Number>
void add_cells(const CompactDelaunay& mesh, const Cavity& cavity, const std::vector<Vector<Number>>& points,
               std::vector<Number>& volumes) {
    for (const std::int32_t id : cavity.all_cells(mesh)) {
        const auto& vertex = mesh.cells()[static_cast<std::size_t>(id)].vertex;
        const auto point = [&](std::size_t k) { return points[cavity.number(vertex[k])]; };
        const std::array<Vector<Number>, 4> p = {point(0), point(1), point(2), point(3)};
        const std::size_t first =
            nearest_to_others({cavity.points[cavity.number(vertex[0])], cavity.points[cavity.number(vertex[1])],
                               cavity.points[cavity.number(vertex[2])], cavity.points[cavity.number(vertex[3])]});
        const auto from_first = [&](int k) { return p[static_cast<std::size_t>(facet_corners[first][k])] - p[first]; };
        const Vector<Number> center =
            p[first] + BoundaryFacet<Vector<Number>, Number>(from_first(0), from_first(1), from_first(2)).center;
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

/// What each of the cavity's vertices loses to the query, from the sites alone.
template <typename Number>
std::vector<Number> stolen(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, Weighting weighting) {
    const bool sibson = weighting == Weighting::sibson;
    std::vector<Number> volumes(cavity.vertices.size(), Number(0));
    std::vector<Vector<Number>> points;
    for (const std::int32_t v : cavity.vertices) {
        points.push_back(relative<Number>(mesh.points()[static_cast<std::size_t>(v)], q));
    }
    if (sibson) {
        add_cells(mesh, cavity, points, volumes);
    }
    for (const auto& facet : cavity.facets) {
        const auto local = [&](std::size_t k) { return static_cast<std::size_t>(facet.vertex[k]); };
        const Vector<Number>&a = points[local(0)], &b = points[local(1)], &c = points[local(2)];
        const BoundaryFacet<Vector<Number>, Number> boundary(a, b, c);
        const auto more = sibson ? boundary.sibson(split(a, b, c)) : boundary.laplace();
        for (std::size_t k = 0; k < 3; ++k) {
            volumes[local(k)] += more[k];
        }
    }
    return volumes;
}

constexpr double long_tolerance = 1e-12;  // of weights below 0; of the identity, in radii of the home's sphere
constexpr double tolerance = 1e-15;       // the same, in distances to the nearest site

double distance_to_nearest(const Cavity& cavity) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec3& p : cavity.points) {
        nearest = std::min(nearest, length(p));
    }
    return nearest;
}

/// \param weight_error, mean_error  how far below 0 a weight, how far from q the mean of the sites may be
/// \returns false, and no shares, where the identity is broken
template <typename Number>
bool shares_of(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, const std::vector<Number>& volumes,
               double weight_error, double mean_error, std::vector<double>& shares) {
    const Number total = std::accumulate(volumes.begin(), volumes.end(), Number(0));
    Vector<Number> mean{Number(0), Number(0), Number(0)};
    shares.clear();
    for (std::size_t v = 0; v < volumes.size(); ++v) {
        const Number share = volumes[v] / total;
        if (!(share >= Number(-weight_error))) {
            return false;
        }
        mean = mean + share * relative<Number>(mesh.points()[static_cast<std::size_t>(cavity.vertices[v])], q);
        shares.push_back(std::max(rounded(share), 0.0));
    }
    return std::sqrt(rounded(dot(mean, mean))) <= mean_error;
}

std::size_t zone_size(const CompactDelaunay& mesh, const Cavity& cavity) {
    std::size_t size = cavity.cells.size() + cavity.facets.size();
    for (const std::uint32_t group : cavity.groups) {
        size += mesh.sphere_tree().cells(group).size();
    }
    return size;
}

void barycentric_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, std::vector<double>& shares) {
    const auto& vertex = mesh.cells()[static_cast<std::size_t>(cavity.home)].vertex;
    std::array<Vec3, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) {
        corners[k] = mesh.points()[static_cast<std::size_t>(vertex[k])];
    }
    const auto coordinates = exact_barycentric(corners, q);
    shares.assign(cavity.vertices.size(), 0.0);
    for (std::size_t k = 0; k < 4; ++k) {
        shares[cavity.number(vertex[k])] = coordinates[k];
    }
}

}  // namespace

bool long_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, Weighting weighting,
                 std::vector<double>& shares) {
    const auto& home = mesh.cells()[static_cast<std::size_t>(cavity.home)];
    const double radius = distance(home.center, mesh.points()[static_cast<std::size_t>(home.vertex[0])]);
    return shares_of(mesh, cavity, q, stolen<long double>(mesh, cavity, q, weighting), long_tolerance,
                     long_tolerance * radius, shares);
}

bool wide_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, Weighting weighting,
                 std::vector<double>& shares) {
    return shares_of(mesh, cavity, q, stolen<Wide>(mesh, cavity, q, weighting), tolerance,
                     tolerance * distance_to_nearest(cavity), shares);
}

bool precise_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, Weighting weighting,
                    std::vector<double>& shares) {
    const double error = tolerance * distance_to_nearest(cavity);
    return shares_of(mesh, cavity, q, stolen<Precise<512>>(mesh, cavity, q, weighting), tolerance, error, shares) ||
           shares_of(mesh, cavity, q, stolen<Precise<4096>>(mesh, cavity, q, weighting), tolerance, error, shares);
}

SharesFrom fallback_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, Weighting weighting,
                           std::vector<double>& shares, const FallbackLimits& limits) {
    const std::size_t size = zone_size(mesh, cavity);
    if (size <= limits.long_doubles && long_shares(mesh, cavity, q, weighting, shares)) {
        return SharesFrom::long_doubles;
    }
    if (size <= limits.wide && wide_shares(mesh, cavity, q, weighting, shares)) {
        return SharesFrom::wide;
    }
    if (size <= limits.precise && precise_shares(mesh, cavity, q, weighting, shares)) {
        return SharesFrom::precise;
    }
    if (cavity.facets.size() <= limits.laplace && wide_shares(mesh, cavity, q, Weighting::laplace, shares)) {
        return SharesFrom::laplace;
    }
    barycentric_shares(mesh, cavity, q, shares);
    return SharesFrom::barycentric;
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
