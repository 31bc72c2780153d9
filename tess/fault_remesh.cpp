// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fault_remesh.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <numbers>

#include "tess/point_grid.hpp"

namespace terratet {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

Vec3 vec(const Kernel::Point_3& p) {
    return {p.x(), p.y(), p.z()};
}

/// False when the triangles are no manifold.
bool to_cgal(const FaultMesh& mesh, SurfaceMesh& result) {
    result.reserve(mesh.points.size(), mesh.triangles.size() * 2, mesh.triangles.size());
    for (const Vec3& p : mesh.points) {
        result.add_vertex({p.x, p.y, p.z});
    }
    for (const Triangle& t : mesh.triangles) {
        const auto v = [&](std::size_t k) { return SurfaceMesh::Vertex_index(t[k]); };
        if (result.add_face(v(0), v(1), v(2)) == SurfaceMesh::null_face()) {
            return false;
        }
    }
    return true;
}

FaultMesh from_cgal(SurfaceMesh& mesh) {
    mesh.collect_garbage();
    FaultMesh result;
    for (const auto v : mesh.vertices()) {
        result.points.push_back(vec(mesh.point(v)));
    }
    for (const auto face : mesh.faces()) {
        Triangle t{};
        std::size_t k = 0;
        for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) {
            t[k++] = static_cast<std::uint32_t>(v.idx());
        }
        result.triangles.push_back(t);
    }
    return result;
}

using CornerMap = SurfaceMesh::Property_map<SurfaceMesh::Vertex_index, bool>;

/// Keeps corners of the rim, where it turns by more than 30°: the sharpest first, and none nearer than half the spacing
/// to another, or a ragged rim would stay as fine as it came.
void constrain_corners(const SurfaceMesh& mesh, double spacing, CornerMap& constrained) {
    std::vector<std::pair<double, SurfaceMesh::Vertex_index>> corners_found;
    for (const auto h : mesh.halfedges()) {
        if (!mesh.is_border(h)) {
            continue;
        }
        const Vec3 before = vec(mesh.point(mesh.source(h)));
        const Vec3 here = vec(mesh.point(mesh.target(h)));
        const Vec3 after = vec(mesh.point(mesh.target(mesh.next(h))));
        const double straightness = dot(unit(here - before), unit(after - here));
        if (straightness < std::cos(std::numbers::pi / 6)) {
            corners_found.emplace_back(straightness, mesh.target(h));
        }
    }
    std::sort(corners_found.begin(), corners_found.end());
    PointGrid kept(0.5 * spacing);
    for (const auto& [straightness, v] : corners_found) {
        if (const Vec3 p = vec(mesh.point(v)); !kept.any_within(p, 0.5 * spacing)) {
            kept.insert(p);
            constrained[v] = true;
        }
    }
}

double farthest(const FaultMesh& from, const FaultMesh& to, const Box3& where, double limit) {
    std::vector<Kernel::Triangle_3> triangles;
    for (const Triangle& t : to.triangles) {
        const auto point = [&](std::size_t k) {
            const Vec3& p = to.points[t[k]];
            return Kernel::Point_3(p.x, p.y, p.z);
        };
        if (const Kernel::Triangle_3 triangle(point(0), point(1), point(2)); !triangle.is_degenerate()) {
            triangles.push_back(triangle);
        }
    }
    if (triangles.empty()) {
        return limit;
    }
    Tree tree(triangles.begin(), triangles.end());
    tree.accelerate_distance_queries();
    double most = 0;
    const auto measure = [&](const Vec3& p) {
        if (where.contains(p)) {
            most = std::max(most, std::sqrt(tree.squared_distance({p.x, p.y, p.z})));
        }
    };
    for (const Vec3& p : from.points) {
        measure(p);
    }
    for (const Triangle& t : from.triangles) {
        measure(centroid(corners(from, t)));
    }
    return std::min(most, limit);
}

std::vector<std::vector<std::uint32_t>> neighbours(const FaultMesh& mesh) {
    std::vector<std::vector<std::uint32_t>> result(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            result[t[k]].push_back(t[(k + 1) % 3]);
            result[t[k]].push_back(t[(k + 2) % 3]);
        }
    }
    for (auto& list : result) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return result;
}

/// Marks the neighbours of the marked as well.
void widen(std::vector<char>& marked, const std::vector<std::vector<std::uint32_t>>& all) {
    const std::vector<char> before = marked;
    for (std::size_t v = 0; v < all.size(); ++v) {
        if (before[v] != 0) {
            for (const std::uint32_t w : all[v]) {
                marked[w] = 1;
            }
        }
    }
}

}  // namespace

bool suits(const FaultMesh& mesh, double spacing) {
    const double wanted = spacing * std::numbers::sqrt2 / 2 * (1 + 1e-6);
    double total = 0;
    double uncovered = 0;
    for (const Triangle& t : mesh.triangles) {
        const TriangleCorners c = corners(mesh, t);
        const double own = length(area_vector(c));
        total += own;
        uncovered += covering_radius(c) > wanted ? own : 0;
    }
    double rim = 0;
    for (const RimEdge& e : rim_edges(mesh)) {
        rim += distance(mesh.points[e.from], mesh.points[e.to]);
    }
    const double needed = total / (spacing * spacing) + 0.5 * rim / spacing + 1;  // of a square lattice
    return uncovered <= 0.02 * total && static_cast<double>(mesh.points.size()) <= 1.6 * needed;
}

FaultMesh remeshed(const FaultMesh& mesh, double spacing) {
    Box3 everywhere = bounding_box(mesh.points);
    everywhere = everywhere.grown(1 + everywhere.diagonal());
    try {
        SurfaceMesh work;
        if (!to_cgal(mesh, work)) {
            return mesh;
        }
        auto constrained = work.add_property_map<SurfaceMesh::Vertex_index, bool>("v:corner", false).first;
        constrain_corners(work, spacing, constrained);
        const auto run = [&](unsigned iterations, unsigned relaxations) {
            pmp::isotropic_remeshing(work.faces(), spacing, work,
                                     CGAL::parameters::number_of_iterations(iterations)
                                         .number_of_relaxation_steps(relaxations)
                                         .vertex_is_constrained_map(constrained));
        };
        // First to size alone: relaxing takes vertex normals, whose cost explodes where collapsing a fine, torn mesh
        // has made fans of hundreds of triangles.
        run(1, 0);
        run(3, 2);
        FaultMesh result = from_cgal(work);
        const bool sound = std::all_of(result.points.begin(), result.points.end(), is_acceptable);
        if (sound && std::abs(area(result) - area(mesh)) <= 0.1 * area(mesh) &&
            deviation(mesh, result, everywhere, spacing) <= 0.5 * spacing) {
            return result;
        }
    } catch (const std::exception&) {  // CGAL's assertions: what it can't remesh is seeded as it is
    }
    return mesh;
}

double deviation(const FaultMesh& a, const FaultMesh& b, const Box3& where, double limit) {
    return std::max(farthest(a, b, where, limit), farthest(b, a, where, limit));
}

Rounding round_bends(FaultMesh& mesh, double spacing) {
    const std::vector<std::vector<std::uint32_t>> all = neighbours(mesh);
    std::vector<std::vector<std::uint32_t>> to_follow = all;  // a rim follows itself, or it would curl
    for (const RimEdge& e : rim_edges(mesh)) {
        to_follow[e.from].clear();
        to_follow[e.to].clear();
    }
    for (const RimEdge& e : rim_edges(mesh)) {
        to_follow[e.from].push_back(e.to);
        to_follow[e.to].push_back(e.from);
    }
    Rounding result;
    for (int round = 0; round < 40; ++round) {
        const std::vector<Vec3> normals = vertex_normals(mesh);
        std::vector<char> moving(mesh.points.size(), 0);
        result.resolved = true;
        for (std::size_t v = 0; v < all.size(); ++v) {
            for (const std::uint32_t w : all[v]) {
                const Vec3 step = mesh.points[w] - mesh.points[v];
                const double across = std::max(length(step), 0.5 * spacing);
                const double off = std::abs(dot(step, normals[v]));
                if (off > 0.1 * across * across / spacing) {
                    result.resolved = false;
                    moving[v] = 1;
                }
                if (round == 0) {
                    result.steepest = std::max(result.steepest, off / across);
                }
            }
        }
        if (result.resolved) {
            return result;
        }
        widen(moving, all);
        widen(moving, all);
        std::vector<Vec3> moved = mesh.points;
        for (std::size_t v = 0; v < all.size(); ++v) {
            if (moving[v] != 0 && !to_follow[v].empty()) {
                Vec3 mean;
                for (const std::uint32_t w : to_follow[v]) {
                    mean = mean + mesh.points[w] / static_cast<double>(to_follow[v].size());
                }
                moved[v] = mesh.points[v] + 0.6 * dot(mean - mesh.points[v], normals[v]) * normals[v];
            }
        }
        mesh.points = std::move(moved);
    }
    return result;
}

}  // namespace terratet
