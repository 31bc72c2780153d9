// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The triangle mesh that the steps of fault preparation hand on, and the measures they share.

#include <span>
#include <vector>

#include "tess/base/triangle_grid.hpp"
#include "tess/geometry.hpp"

namespace terratet {

/// An oriented mesh; after repair edge-manifold. Normals follow the right-hand rule.
struct TriMesh {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
};

inline bool has(const Triangle& t, std::uint32_t v) {
    return t[0] == v || t[1] == v || t[2] == v;
}

TriangleCorners corners(const TriMesh& mesh, const Triangle& t);

/// Half the cross product of two edges: normal times area.
Vec3 area_vector(const TriangleCorners& t);
double area(const TriMesh& mesh);

/// a/|a|, or zero for a vector without length.
Vec3 unit(const Vec3& a);

/// Area-weighted unit normals at the points; zero where a point has no triangle.
std::vector<Vec3> vertex_normals(const TriMesh& mesh);

/// An edge with one triangle, in that triangle's sense: the surface is on its left, seen from above.
struct RimEdge {
    std::uint32_t from = 0;
    std::uint32_t to = 0;
};
std::vector<RimEdge> rim_edges(const TriMesh& mesh);

/// Drops points without a triangle; the others keep their order.
void compact(TriMesh& mesh);

/// Adds the triangles of `more` with their points, unconnected.
void append(TriMesh& mesh, const TriMesh& more);

/// The largest distance of the triangle's points to their nearest corner: the circumradius when acute, less and reached
/// on the longest edge when obtuse.
double covering_radius(const TriangleCorners& t);

Vec3 centroid(const TriangleCorners& t);

/// Distance from `center` to the farthest corner.
double radius_about(const Vec3& center, const TriangleCorners& t);

/// The four triangles between edge midpoints.
std::array<TriangleCorners, 4> quartered(const TriangleCorners& t);

/// Is f ≥ bound all over the triangle, for an f that changes by no more than the distance moved? May say no when f
/// comes within 2 × `finest` of the bound.
template <class Function>
bool at_least_throughout(const TriangleCorners& t, const Function& f, double bound, double finest) {
    std::vector<TriangleCorners> open{t};
    while (!open.empty()) {
        const TriangleCorners piece = open.back();
        open.pop_back();
        const Vec3 middle = centroid(piece);
        const double value = f(middle);
        const double radius = radius_about(middle, piece);
        if (value - radius >= bound) {
            continue;
        }
        if (value < bound || radius <= finest) {
            return false;
        }
        const auto quarters = quartered(piece);
        open.insert(open.end(), quarters.begin(), quarters.end());
    }
    return true;
}

}  // namespace terratet
