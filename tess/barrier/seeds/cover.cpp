// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/seeds/cover.hpp"

#include "tess/base/grid.hpp"

namespace terratet {
namespace {

Grid<BasePoint> grid_of(const std::vector<BasePoint>& base, double radius) {
    Grid<BasePoint> grid(radius);
    for (const BasePoint& b : base) {
        grid.insert(b.position, b);
    }
    return grid;
}

bool faces(const BasePoint& b, const Vec3& normal) {
    return dot(b.normal, normal) >= 0.5;
}

/// Adds a base point wherever a piece of the mesh lies in no base point's ball. A piece in one ball is covered, balls
/// being convex; others are quartered down to a twelfth of the radius, and then get a point of their own.
void fill(const TriMesh& mesh, double radius, std::size_t most, const std::function<bool(const Vec3&)>& allowed,
          Grid<BasePoint>& grid, std::vector<BasePoint>& base) {
    const std::vector<Vec3> normals = vertex_normals(mesh);
    for (const Triangle& t : mesh.triangles) {
        const TriangleCorners whole = corners(mesh, t);
        const Vec3 facing = unit(area_vector(whole));
        if (facing == Vec3{}) {
            continue;
        }
        const auto normal_at = [&](const Vec3& p) {
            const double a = dot(facing, area_vector({p, whole[1], whole[2]}));
            const double b = dot(facing, area_vector({p, whole[2], whole[0]}));
            const double c = dot(facing, area_vector({p, whole[0], whole[1]}));
            return unit(a * normals[t[0]] + b * normals[t[1]] + c * normals[t[2]]);
        };
        std::vector<TriangleCorners> open{whole};
        while (!open.empty() && base.size() <= most) {
            const TriangleCorners piece = open.back();
            open.pop_back();
            const Vec3 middle = centroid(piece);
            const double size = radius_about(middle, piece);
            if (size <= 2 * radius && grid.any_near(middle, [&](const BasePoint& b) {
                    return faces(b, facing) && radius_about(b.position, piece) <= radius;
                })) {
                continue;
            }
            if (size <= radius / 12) {
                if (!allowed(middle)) {
                    continue;
                }
                const Vec3 normal = normal_at(middle);
                const BasePoint added{middle, faces({middle, normal}, facing) ? normal : facing};
                base.push_back(added);
                grid.insert(added.position, added);
                continue;
            }
            const auto quarters = quartered(piece);
            open.insert(open.end(), quarters.rbegin(), quarters.rend());
        }
    }
}

}  // namespace

void cover(const TriMesh& mesh, double radius, std::size_t most, const std::function<bool(const Vec3&)>& allowed,
           std::vector<BasePoint>& base) {
    Grid<BasePoint> grid = grid_of(base, radius);
    fill(mesh, radius, most, allowed, grid, base);
}

double covering_radius(const TriMesh& mesh, const std::vector<BasePoint>& base, double at_most) {
    const Grid<BasePoint> grid = grid_of(base, at_most);
    double reached = 0;  // by some point, so the truth is no less
    double bound = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 facing = unit(area_vector(corners(mesh, t)));
        std::vector<TriangleCorners> open{corners(mesh, t)};
        while (!open.empty() && facing != Vec3{}) {
            const TriangleCorners piece = open.back();
            open.pop_back();
            const Vec3 middle = centroid(piece);
            double near = at_most;
            double single = std::numeric_limits<double>::infinity();  // smallest ball round a base point with all of it
            grid.any_near(middle, [&](const BasePoint& b) {
                if (faces(b, facing)) {
                    near = std::min(near, distance(b.position, middle));
                    single = std::min(single, radius_about(b.position, piece));
                }
                return false;
            });
            const double size = radius_about(middle, piece);
            if (near >= at_most && size <= at_most / 8) {  // left uncovered on purpose
                bound = at_most;
                continue;
            }
            reached = std::max(reached, near);
            if (const double within = std::min(single, near + size);
                within <= 1.01 * reached || size <= 0.005 * at_most) {
                bound = std::max(bound, within);
                continue;
            }
            const auto quarters = quartered(piece);
            open.insert(open.end(), quarters.begin(), quarters.end());
        }
    }
    return std::min(bound, at_most);
}

}  // namespace terratet
