// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangulation of points and of polygons in their best-fit plane (surface.hpp). Apart from surface.cpp because of
// CGAL.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tess/surface.hpp"

namespace terratet {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;

/// A hull triangle lower than this part of its longest edge is an artefact of rounding: the hull runs straight there.
constexpr double flat_to_rounding = 1e-9;

struct Plane {
    Vec3 origin;
    Vec3 u, v;  ///< orthonormal in the plane; u × v is its normal
};

/// The side a normal points to: up, else +y, else +x. Nearly vertical planes are no special case: whichever way the
/// last bits lean them, the answer is the same for the same points.
Vec3 canonical_side(const Vec3& n) {
    const bool flip = n.z != 0 ? n.z < 0 : n.y != 0 ? n.y < 0 : n.x < 0;
    return flip ? -n : n;
}

Vec3 normalized(const Vec3& a) {
    return a / length(a);
}

/// u is horizontal (along strike), so that it does not depend on how the points spread within the plane.
Plane plane_with_normal(const Vec3& origin, const Vec3& normal) {
    const Vec3 strike = cross({0, 0, 1}, normal);
    const Vec3 u = length(strike) > 1e-6 ? normalized(strike) : normalized(cross({0, 1, 0}, normal));
    return {origin, u, cross(normal, u)};
}

/// Least squares: the normal is the direction in which the points spread least.
Plane best_fit_plane(std::span<const Vec3> points) {
    Vec3 mean;
    for (const Vec3& p : points) {
        mean = mean + (p - points[0]) / static_cast<double>(points.size());
    }
    mean = mean + points[0];
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Vec3& p : points) {
        const Vec3 d = p - mean;
        const Eigen::Vector3d e(d.x, d.y, d.z);
        covariance += e * e.transpose();
    }
    const Eigen::Vector3d normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0);
    return plane_with_normal(mean, normalized(canonical_side({normal.x(), normal.y(), normal.z()})));
}

Point2 project(const Plane& plane, const Vec3& p) {
    const Vec3 d = p - plane.origin;
    return {dot(d, plane.u), dot(d, plane.v)};
}

/// Starting with the smallest corner, same turn.
Triangle canonical(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

double longest_edge(const std::vector<Vec3>& p, const Triangle& t) {
    return std::max({distance(p[t[0]], p[t[1]]), distance(p[t[1]], p[t[2]]), distance(p[t[2]], p[t[0]])});
}

/// Keeps what `keep` accepts.
template <typename Predicate>
void retain(std::vector<Triangle>& triangles, const Predicate& keep) {
    std::erase_if(triangles, [&](const Triangle& t) { return !keep(t); });
}

double median_edge(const Surface& surface) {
    std::vector<double> edges;
    for (const Triangle& t : surface.triangles) {
        for (int k = 0; k < 3; ++k) {
            edges.push_back(distance(surface.vertices[t[k]], surface.vertices[t[(k + 1) % 3]]));
        }
    }
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::nth_element(edges.begin(), middle, edges.end());
    return *middle;
}

/// Drops vertices that no triangle uses, keeping the order of the others.
void drop_unused_vertices(Surface& surface) {
    constexpr std::uint32_t unused = ~std::uint32_t{0};
    std::vector<std::uint32_t> index(surface.vertices.size(), unused);
    for (const Triangle& t : surface.triangles) {
        for (const std::uint32_t v : t) {
            index[v] = 0;
        }
    }
    std::uint32_t count = 0;
    for (std::size_t v = 0; v < index.size(); ++v) {
        if (index[v] != unused) {
            surface.vertices[count] = surface.vertices[v];
            index[v] = count++;
        }
    }
    surface.vertices.resize(count);
    for (Triangle& t : surface.triangles) {
        t = {index[t[0]], index[t[1]], index[t[2]]};
    }
}

using Delaunay = CGAL::Delaunay_triangulation_2<
    Kernel, CGAL::Triangulation_data_structure_2<VertexBase, CGAL::Triangulation_face_base_with_info_2<bool, Kernel>>>;

/// Takes flat triangles off the hull, from outside inwards; info() of a face says that it is gone.
void peel_flat_hull(Delaunay& delaunay) {
    std::vector<Delaunay::Face_handle> outside;
    for (const auto face : delaunay.all_face_handles()) {
        face->info() = delaunay.is_infinite(face);
        if (face->info()) {
            outside.push_back(face);
        }
    }
    while (!outside.empty()) {
        const auto face = outside.back();
        outside.pop_back();
        for (int k = 0; k < 3; ++k) {
            const auto inner = face->neighbor(k);
            if (inner->info()) {
                continue;
            }
            const int apex = inner->index(face);
            const double base = CGAL::to_double(delaunay.segment(inner, apex).squared_length());
            const double twice_area = 2 * CGAL::to_double(delaunay.triangle(inner).area());
            if (twice_area < flat_to_rounding * base) {
                inner->info() = true;
                outside.push_back(inner);
            }
        }
    }
}

}  // namespace

Surface triangulate_in_best_fit_plane(std::string name, std::vector<Vec3> points, double max_edge_factor) {
    Surface surface;
    surface.name = std::move(name);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) {
        return surface;
    }
    const Plane plane = best_fit_plane(points);
    std::vector<std::pair<Point2, std::uint32_t>> projected;
    projected.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        projected.emplace_back(project(plane, points[i]), i);
    }
    // Of equal projections the one with the smallest index counts: CGAL would keep the first of its own order.
    std::sort(projected.begin(), projected.end());
    projected.erase(std::unique(projected.begin(), projected.end(),
                                [](const auto& a, const auto& b) { return a.first == b.first; }),
                    projected.end());

    Delaunay delaunay(projected.begin(), projected.end());
    if (delaunay.dimension() < 2) {
        return surface;
    }
    peel_flat_hull(delaunay);
    for (const auto face : delaunay.finite_face_handles()) {
        if (!face->info()) {
            surface.triangles.push_back(
                canonical({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()}));
        }
    }
    surface.vertices = std::move(points);
    if (max_edge_factor > 0 && !surface.triangles.empty()) {
        const double limit = max_edge_factor * median_edge(surface);
        retain(surface.triangles, [&](const Triangle& t) { return longest_edge(surface.vertices, t) <= limit; });
    }
    std::sort(surface.triangles.begin(), surface.triangles.end());
    drop_unused_vertices(surface);
    return surface;
}

namespace {

using Constrained = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel,
    CGAL::Triangulation_data_structure_2<
        VertexBase,
        CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>>,
    CGAL::No_constraint_intersection_tag>;

/// How many rings lie between a face and the outside, in info().
void mark_nesting(Constrained& cdt) {
    for (const auto face : cdt.all_face_handles()) {
        face->info() = -1;
    }
    std::vector<Constrained::Face_handle> level{cdt.infinite_face()}, next;
    for (int depth = 0; !level.empty(); ++depth) {
        while (!level.empty()) {
            const auto face = level.back();
            level.pop_back();
            if (face->info() != -1) {
                continue;
            }
            face->info() = depth;
            for (int k = 0; k < 3; ++k) {
                (face->is_constrained(k) ? next : level).push_back(face->neighbor(k));
            }
        }
        std::swap(level, next);
    }
}

/// Newell's normal: of the outer ring, whatever its shape.
Vec3 ring_normal(const std::vector<Vec3>& ring) {
    Vec3 sum;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        sum = sum + cross(ring[i] - ring[0], ring[i + 1] - ring[0]);
    }
    return sum;
}

/// Constrained triangulation of the rings' projections; nothing when rings touch or cross.
std::optional<Constrained> constrained_triangulation(std::span<const std::vector<Vec3>> rings, const Plane& plane) {
    Constrained cdt;
    std::uint32_t index = 0;
    try {
        for (const std::vector<Vec3>& ring : rings) {
            std::vector<Constrained::Vertex_handle> corners;
            for (const Vec3& p : ring) {
                const std::size_t before = cdt.number_of_vertices();
                corners.push_back(cdt.insert(project(plane, p)));
                if (cdt.number_of_vertices() == before) {
                    return std::nullopt;
                }
                corners.back()->info() = index++;
            }
            for (std::size_t i = 0; i < corners.size(); ++i) {
                cdt.insert_constraint(corners[i], corners[(i + 1) % corners.size()]);
            }
        }
    } catch (const Constrained::Intersection_of_constraints_exception&) {
        return std::nullopt;
    }
    return cdt;
}

}  // namespace

std::vector<Triangle> triangulate_polygon(std::span<const std::vector<Vec3>> rings) {
    if (rings.empty() || std::any_of(rings.begin(), rings.end(), [](const auto& r) { return r.size() < 3; })) {
        return {};
    }
    const Vec3 normal = ring_normal(rings[0]);
    if (!(squared_length(normal) > 0)) {
        return {};
    }
    if (rings.size() == 1 && rings[0].size() == 3) {
        return {{0, 1, 2}};
    }
    auto cdt = constrained_triangulation(rings, plane_with_normal(rings[0][0], normalized(normal)));
    if (!cdt) {
        return {};
    }
    mark_nesting(*cdt);
    std::vector<Triangle> triangles;
    for (const auto face : cdt->finite_face_handles()) {
        if (face->info() % 2 == 1) {
            triangles.push_back(canonical({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()}));
        }
    }
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

}  // namespace terratet
