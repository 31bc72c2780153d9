// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Gmsh on the task of peer.hpp, as a process of its own:
///
///   gmsh_peer SIZE < TASK > RESULT
///
/// TASK: the box's six coordinates and then the points', as text. RESULT: the fields of MeshResult in their order.

#include <gmsh.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "peer.hpp"
#include "timing.hpp"

using namespace terratet;
using namespace terratet::bench;

namespace {

/// Points as the vertices of Gmsh's mesh, found by their tags.
std::vector<CellPoints> cells_of_mesh() {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates;
    std::vector<double> unused;
    gmsh::model::mesh::getNodes(tags, coordinates, unused);
    std::vector<Vec3> point(1 + *std::ranges::max_element(tags));
    for (std::size_t i = 0; i < tags.size(); ++i) {
        point[tags[i]] = {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
    }
    constexpr int tetrahedron = 4;
    std::vector<std::size_t> cell_tags;
    std::vector<std::size_t> corners;
    gmsh::model::mesh::getElementsByType(tetrahedron, cell_tags, corners);
    std::vector<CellPoints> cells(corners.size() / 4);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        for (std::size_t k = 0; k < 4; ++k) {
            cells[c][k] = point[corners[4 * c + k]];
        }
    }
    return cells;
}

MeshResult run(const PointsInBox& task, double size, bool optimise) {
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::option::setNumber("Mesh.Algorithm3D", 1);  // Delaunay
    gmsh::option::setNumber("Mesh.Optimize", optimise ? 1 : 0);
    gmsh::option::setNumber("Mesh.MeshSizeMin", size);
    gmsh::option::setNumber("Mesh.MeshSizeMax", size);
    const Vec3 extent = task.box.size();
    const int volume =
        gmsh::model::occ::addBox(task.box.lo.x, task.box.lo.y, task.box.lo.z, extent.x, extent.y, extent.z);
    std::vector<int> embedded;
    for (const Vec3& p : task.points) {
        embedded.push_back(gmsh::model::occ::addPoint(p.x, p.y, p.z, size));
    }
    gmsh::model::occ::synchronize();
    gmsh::model::mesh::embed(0, embedded, 3, volume);
    const double start = cpu_s();
    gmsh::model::mesh::generate(3);
    const double seconds = cpu_s() - start;
    const auto cells = cells_of_mesh();
    double vertices = 0;
    gmsh::option::getNumber("Mesh.NbNodes", vertices);
    return measured(seconds, static_cast<std::size_t>(vertices), cells.size(), [&](std::size_t c) { return cells[c]; });
}

}  // namespace

int main(int, char** argv) {
    PointsInBox task;
    Vec3& lo = task.box.lo;
    Vec3& hi = task.box.hi;
    std::cin >> lo.x >> lo.y >> lo.z >> hi.x >> hi.y >> hi.z;
    for (Vec3 p; std::cin >> p.x >> p.y >> p.z;) {
        task.points.push_back(p);
    }
    gmsh::initialize();
    const MeshResult r = run(task, std::atof(argv[1]), argv[2][0] == '1');
    gmsh::finalize();
    std::printf("%.9g %zu %zu %.9g %.9g %.9g\n", r.seconds, r.vertices, r.cells, r.longest_edge, r.dihedral_p1_deg,
                r.sharp_percent);
}
