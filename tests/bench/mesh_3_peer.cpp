// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_polyhedron_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polygon_mesh_processing/triangulate_faces.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/boost/graph/generators.h>
#include <CGAL/make_mesh_3.h>
#include <tbb/global_control.h>

#include "peer.hpp"
#include "timing.hpp"

namespace terratet::bench {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain3 = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel>;

Polyhedron polyhedron(const Box3& box) {
    const auto p = [&](bool x, bool y, bool z) {
        return Kernel::Point_3(x ? box.hi.x : box.lo.x, y ? box.hi.y : box.lo.y, z ? box.hi.z : box.lo.z);
    };
    Polyhedron result;
    CGAL::make_hexahedron(p(false, false, false), p(true, false, false), p(true, true, false), p(false, true, false),
                          p(false, true, true), p(false, false, true), p(true, false, true), p(true, true, true),
                          result);
    CGAL::Polygon_mesh_processing::triangulate_faces(result);
    return result;
}

template <class Concurrency>
MeshResult meshed(const PointsInBox& task, double size, bool optimise, double (*clock)()) {
    namespace parameters = CGAL::parameters;
    using Triangulation3 = typename CGAL::Mesh_triangulation_3<Domain3, CGAL::Default, Concurrency>::type;
    using Complex =
        CGAL::Mesh_complex_3_in_triangulation_3<Triangulation3, Domain3::Corner_index, Domain3::Curve_index>;
    const Polyhedron box = polyhedron(task.box);
    Domain3 domain(box);
    domain.detect_features(60);
    const CGAL::Mesh_criteria_3<Triangulation3> criteria(
        parameters::edge_size = size, parameters::facet_angle = 25, parameters::facet_size = size,
        parameters::facet_distance = size / 10, parameters::cell_radius_edge_ratio = 2, parameters::cell_size = size);
    const double start = clock();
    const auto mesh =
        optimise ? CGAL::make_mesh_3<Complex>(domain, criteria)
                 : CGAL::make_mesh_3<Complex>(domain, criteria, parameters::no_perturb(), parameters::no_exude());
    const double seconds = clock() - start;
    std::vector<CellPoints> cells;
    for (auto cell = mesh.cells_in_complex_begin(); cell != mesh.cells_in_complex_end(); ++cell) {
        CellPoints corners;
        for (int k = 0; k < 4; ++k) {
            const auto& p = cell->vertex(k)->point();
            corners[static_cast<std::size_t>(k)] = {p.x(), p.y(), p.z()};
        }
        cells.push_back(corners);
    }
    return measured(seconds, mesh.triangulation().number_of_vertices(), cells.size(),
                    [&](std::size_t c) { return cells[c]; });
}

}  // namespace

MeshResult mesh_3(const PointsInBox& task, double size, bool optimise, int threads) {
    if (threads == 1) {
        return meshed<CGAL::Sequential_tag>(task, size, optimise, cpu_s);
    }
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    return meshed<CGAL::Parallel_tag>(task, size, optimise, wall_s);
}

}  // namespace terratet::bench
