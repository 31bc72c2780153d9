// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mesh/quality.hpp"
#include "tess/base/tetrahedron.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace terratet {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// The face opposite each corner, outward for a positively oriented cell.

/// Twice-area vectors of the four faces.
std::array<Vec3, 4> face_vectors(const CellPoints& p) {
    std::array<Vec3, 4> vectors;
    for (int k = 0; k < 4; ++k) {
        const Vec3& a = p[facet_corners[k][0]];
        vectors[static_cast<std::size_t>(k)] = cross(p[facet_corners[k][1]] - a, p[facet_corners[k][2]] - a);
    }
    return vectors;
}

/// Cosines of the smallest and the largest dihedral angle; the angle between faces i and j is π minus that between
/// their outward normals, whatever the orientation of the cell.
std::pair<double, double> dihedral_cosines(const std::array<Vec3, 4>& faces) {
    double largest = -1;
    double smallest = 1;
    std::array<double, 4> lengths{};
    for (std::size_t i = 0; i < 4; ++i) {
        lengths[i] = length(faces[i]);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
            const double scale = lengths[i] * lengths[j];
            const double cosine = scale > 0 ? std::clamp(-dot(faces[i], faces[j]) / scale, -1.0, 1.0) : 1.0;
            largest = std::max(largest, cosine);
            smallest = std::min(smallest, cosine);
        }
    }
    return {largest, smallest};
}

}  // namespace

CellQuality cell_quality(const CellPoints& p) {
    CellQuality q;
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
            const double d = squared_distance(p[i], p[j]);
            shortest = std::min(shortest, d);
            longest = std::max(longest, d);
        }
    }
    q.shortest_edge = std::sqrt(shortest);
    q.longest_edge = std::sqrt(longest);
    q.volume = std::abs(dot(p[1] - p[0], cross(p[2] - p[0], p[3] - p[0]))) / 6;
    const auto faces = face_vectors(p);
    double area = 0;
    for (const Vec3& face : faces) {
        area += length(face) / 2;
    }
    q.inradius = area > 0 ? 3 * q.volume / area : 0;
    const Circumsphere sphere = circumsphere(p);
    q.circumradius = std::isfinite(sphere.squared_radius) ? std::sqrt(sphere.squared_radius)
                                                          : std::numeric_limits<double>::infinity();
    q.radius_edge = q.circumradius / q.shortest_edge;
    q.aspect = q.inradius > 0 ? q.circumradius / q.inradius : std::numeric_limits<double>::infinity();
    const auto [largest_cosine, smallest_cosine] = dihedral_cosines(faces);
    q.dihedral_min_deg = std::acos(largest_cosine) * degrees;
    q.dihedral_max_deg = std::acos(smallest_cosine) * degrees;
    return q;
}

/// Divides only where an angle is the sharpest so far, which is seldom.
double cell_sharpness(const CellPoints& p, double least, double enough) {
    const Vec3 a = p[1] - p[0];
    const Vec3 b = p[2] - p[0];
    const Vec3 c = p[3] - p[0];
    std::array<Vec3, 4> faces{{{}, cross(c, b), cross(a, c), cross(b, a)}};
    faces[0] = -(faces[1] + faces[2] + faces[3]);  // the areas of a closed surface cancel
    std::array<double, 4> squares{};
    for (std::size_t i = 0; i < 4; ++i) {
        squares[i] = squared_length(faces[i]);
    }
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = i + 1; j < 4; ++j) {
            const double product = sharpness(-dot(faces[i], faces[j]));
            const double scale = squares[i] * squares[j];
            if (!(product < least * scale)) {  // holds for a face without area
                least = scale > 0 ? product / scale : std::numeric_limits<double>::infinity();
                if (least > enough) {
                    return least;
                }
            }
        }
    }
    return least;
}

Circumsphere circumsphere(const CellPoints& p) {
    const Vec3 a = p[1] - p[0];
    const Vec3 b = p[2] - p[0];
    const Vec3 c = p[3] - p[0];
    const Vec3 bc = cross(b, c);
    const double six_volumes = dot(a, bc);
    const Vec3 offset = (squared_length(a) * bc + squared_length(b) * cross(c, a) + squared_length(c) * cross(a, b)) /
                        (2 * six_volumes);
    const double squared_radius = squared_length(offset);
    return {p[0] + offset, std::isfinite(squared_radius) ? squared_radius : std::numeric_limits<double>::infinity(),
            six_volumes};
}

}  // namespace terratet
