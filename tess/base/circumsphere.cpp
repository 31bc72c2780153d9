// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/base/circumsphere.hpp"

#include <CGAL/Exact_rational.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "tess/base/wide.hpp"

namespace terratet {
namespace {

using Rational = CGAL::Simple_cartesian<CGAL::Exact_rational>;

// What centres are computed to, whatever is asked for: the weights of places between tall, thin Voronoi cells need it.
constexpr double wanted_error = 1e-13;

template <typename Real>
constexpr Real epsilon_of = std::numeric_limits<Real>::epsilon();
template <>
constexpr Wide epsilon_of<Wide> = wide_epsilon;

/// With a, b, c from the first point, the centre lies at (|a|² b×c + |b|² c×a + |c|² a×b) / 2 det(a,b,c). Forward error
/// analysis: off by less than 100 u |a||b||c| / |det| radii.
template <typename Real>
std::optional<Vec3> center_within(const std::array<Vec3, 4>& p, double relative_error) {
    struct V {
        Real x, y, z;
    };
    const auto from_first = [&](const Vec3& q) {
        return V{Real(q.x) - Real(p[0].x), Real(q.y) - Real(p[0].y), Real(q.z) - Real(p[0].z)};
    };
    const auto cross3 = [](const V& u, const V& v) {
        return V{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    };
    const auto dot3 = [](const V& u, const V& v) { return u.x * v.x + u.y * v.y + u.z * v.z; };

    const V a = from_first(p[1]), b = from_first(p[2]), c = from_first(p[3]);
    const Real aa = dot3(a, a), bb = dot3(b, b), cc = dot3(c, c);
    const V bc = cross3(b, c), ca = cross3(c, a), ab = cross3(a, b);
    const Real det = dot3(a, bc);
    const double lengths =
        std::sqrt(static_cast<double>(aa)) * std::sqrt(static_cast<double>(bb)) * std::sqrt(static_cast<double>(cc));
    const Real bound = Real(100) * epsilon_of<Real> * Real(lengths);
    if (!(bound < Real(relative_error) * (det < 0 ? -det : det))) {
        return std::nullopt;
    }
    const Real s = Real(0.5) / det;
    return Vec3{static_cast<double>(Real(p[0].x) + s * (aa * bc.x + bb * ca.x + cc * ab.x)),
                static_cast<double>(Real(p[0].y) + s * (aa * bc.y + bb * ca.y + cc * ab.y)),
                static_cast<double>(Real(p[0].z) + s * (aa * bc.z + bb * ca.z + cc * ab.z))};
}

Vec3 exact_center(const std::array<Vec3, 4>& p) {
    const auto exact = [](const Vec3& q) { return Rational::Point_3(q.x, q.y, q.z); };
    const auto center = CGAL::circumcenter(exact(p[0]), exact(p[1]), exact(p[2]), exact(p[3]));
    return {CGAL::to_double(center.x()), CGAL::to_double(center.y()), CGAL::to_double(center.z())};
}

}  // namespace

std::size_t nearest_to_others(const std::array<Vec3, 4>& points) {
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
        double product = 1;
        for (std::size_t i = 1; i < 4; ++i) {
            product *= squared_distance(points[k], points[(k + i) % 4]);
        }
        if (product < least) {
            least = product;
            nearest = k;
        }
    }
    return nearest;
}

CertifiedSphere certified_circumsphere(const std::array<Vec3, 4>& points, double relative_error) {
    const double half = relative_error / 2;  // the other half is for rounding the result
    const double wanted = std::min(half, wanted_error);
    auto sorted = points;
    std::swap(sorted[0], sorted[nearest_to_others(points)]);
    auto center = center_within<double>(sorted, wanted);
    if (!center) {
        center = center_within<long double>(sorted, wanted);
    }
    if (!center) {
        center = center_within<Wide>(sorted, wanted);
    }
    if (!center) {
        center = exact_center(sorted);
    }
    const double squared_radius = squared_distance(*center, sorted[0]);
    const double rounding = std::numeric_limits<double>::epsilon() * (length(*center) + length(sorted[0]));
    return {*center, squared_radius, rounding < half * std::sqrt(squared_radius)};
}

}  // namespace terratet
