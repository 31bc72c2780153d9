// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What is behind a tessellation: CGAL's dynamic Delaunay triangulation with our vertex table. The only header of the
/// floor that names CGAL's triangulation, included by the few files that insert, remove or walk.

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include "tess/base/no_index.hpp"
#include "tess/tet_mesh.hpp"

namespace terratet::delaunay {

using Epick = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Epick>;  // index in the vertex table

/// Not a number: no comparison with it holds.
inline constexpr float unknown_radius = std::numeric_limits<float>::quiet_NaN();

/// Scratch for whoever works on the cells; nothing here outlives an operation.
struct CellInfo {
    std::array<float, 3> center{};  ///< ConflictSearch's cached circumsphere
    float squared_radius = unknown_radius;
    std::uint32_t tag = no_index;  ///< a slot or number
};

using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<CellInfo, Epick, CGAL::Delaunay_triangulation_cell_base_3<Epick>>;
using Triangulation = CGAL::Delaunay_triangulation_3<Epick, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Point = Epick::Point_3;
using Cell = Triangulation::Cell_handle;
using Facet = Triangulation::Facet;
using VertexHandle = Triangulation::Vertex_handle;

inline Point to_cgal(const Vec3& p) {
    return {p.x, p.y, p.z};
}
inline Vec3 from_cgal(const Point& p) {
    return {p.x(), p.y(), p.z()};
}

/// What is behind a tessellation.
struct Core {
    Triangulation triangulation;
    std::vector<Vertex> vertices;  ///< ascending id; a CGAL vertex's info is its index here
    std::uint64_t next_id = 0;
};

}  // namespace terratet::delaunay
