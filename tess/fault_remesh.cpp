// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fault_remesh.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <numbers>

namespace terratet {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
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

/// Corners of the rim: where it turns by more than 30°.
void constrain_corners(const SurfaceMesh& mesh,
                       SurfaceMesh::Property_map<SurfaceMesh::Vertex_index, bool>& constrained) {
    for (const auto h : mesh.halfedges()) {
        if (!mesh.is_border(h)) {
            continue;
        }
        const Vec3 before = vec(mesh.point(mesh.source(h)));
        const Vec3 here = vec(mesh.point(mesh.target(h)));
        const Vec3 after = vec(mesh.point(mesh.target(mesh.next(h))));
        if (dot(unit(here - before), unit(after - here)) < std::cos(std::numbers::pi / 6)) {
            constrained[mesh.target(h)] = true;
        }
    }
}

double farthest(const FaultMesh& from, const FaultMesh& to, const Box3& where, double limit) {
    std::vector<TriangleCorners> triangles;
    for (const Triangle& t : to.triangles) {
        triangles.push_back(corners(to, t));
    }
    const std::vector<double> reach(triangles.size(), limit);
    const TriangleGrid grid(std::move(triangles), reach);
    double most = 0;
    const auto measure = [&](const Vec3& p) {
        if (!where.contains(p)) {
            return;
        }
        double least = limit * limit;
        for (const std::uint32_t i : grid.candidates(p)) {
            least = std::min(least, grid.squared_distance_to(i, p));
        }
        most = std::max(most, std::sqrt(least));
    };
    for (const Vec3& p : from.points) {
        measure(p);
    }
    for (const Triangle& t : from.triangles) {
        measure(centroid(corners(from, t)));
    }
    return most;
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
        constrain_corners(work, constrained);
        pmp::isotropic_remeshing(
            work.faces(), spacing, work,
            CGAL::parameters::number_of_iterations(4).number_of_relaxation_steps(2).vertex_is_constrained_map(
                constrained));
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

void smooth(FaultMesh& mesh, const std::vector<char>& movable) {
    std::vector<Vec3> sum(mesh.points.size());
    std::vector<int> count(mesh.points.size(), 0);
    std::vector<char> on_rim(mesh.points.size(), 0);
    const auto link = [&](std::uint32_t v, std::uint32_t w) {
        sum[v] = sum[v] + mesh.points[w];
        ++count[v];
    };
    const std::vector<RimEdge> rim = rim_edges(mesh);
    for (const RimEdge& e : rim) {
        on_rim[e.from] = on_rim[e.to] = 1;
        link(e.from, e.to);
        link(e.to, e.from);
    }
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (const std::uint32_t w : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
                if (on_rim[t[k]] == 0) {
                    link(t[k], w);
                }
            }
        }
    }
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        // A rim's corner would creep inwards: rims are smoothed only where they run on.
        if (movable[v] != 0 && count[v] > 0 && on_rim[v] == 0) {
            mesh.points[v] = 0.5 * (mesh.points[v] + sum[v] / count[v]);
        }
    }
}

}  // namespace terratet
