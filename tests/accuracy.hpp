// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What adaptivity buys: how far piecewise linear fields are from the truth, where the truth is a formula. The adaptive
/// tessellation against a uniform grid and a uniform tetrahedral mesh that may use as many values (docs/accuracy.md).

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tess/build.hpp"

namespace terratet::testing {

/// A made-up site whose property is a formula, with the criteria to tessellate it by.
struct AnalyticSite {
    std::string name;
    std::function<double(const Vec3&)> field;
    Site site;  ///< wells with samples of the field, and its fault
    BuildOptions options;
};

/// Three sites of 1000 × 1000 × 500 with `wells` by `wells` wells, a sample every 2. `scale` stretches the layer's or
/// the zone's thickness and the criteria with it: 1 for the published table, more for quicker work.
AnalyticSite smooth_trend(double scale, int wells = 5);
AnalyticSite thin_layer(double scale, int wells = 5);
AnalyticSite raised_zone(double scale, int wells = 5);

/// A tetrahedral mesh with a value at each vertex, and what parts it.
struct MeshField {
    TetMesh mesh;
    std::vector<Vertex> vertices;
    std::vector<double> values;
    std::vector<Barrier> barriers;
};

/// Values on the nodes of a grid that covers a box from face to face.
struct GridField {
    Box3 box;
    std::array<int, 3> nodes{};
    std::vector<double> values;  ///< x slowest
};

/// The adaptive tessellation: values from the formula, at samples, seeds and inserted vertices alike.
MeshField adaptive(const AnalyticSite& site, BuildReport& report);

/// Its vertices in a row.
MeshField field_of(const Model& model);

/// Nearly equal cells, at most `count` values: a cubic grid.
GridField uniform_grid(const AnalyticSite& site, std::size_t count);

/// The Delaunay tessellation of a body-centred cubic lattice, the most uniform tetrahedra that fill space, closed by a
/// row of vertices on each face of the box; at most `count` vertices.
MeshField uniform_mesh(const AnalyticSite& site, std::size_t count);

/// Where a grid's values are, in their order.
std::vector<Vec3> nodes(const GridField& grid);

/// `count` places of the extent: Roberts' quasi-random sequence R3, in an order in which consecutive ones are near.
std::vector<Vec3> probes(const Box3& extent, std::size_t count);

/// Error at each place; in a fault's gap from the place's own side, as everywhere in Terratet.
std::vector<double> errors(const MeshField& field, const AnalyticSite& site, std::span<const Vec3> places);
std::vector<double> errors(const GridField& field, const AnalyticSite& site, std::span<const Vec3> places);

/// Where a mesh's cells meet the plane on which the given axis (0, 1, 2) has the given value: convex polygons in order.
std::vector<std::vector<Vec3>> section(const TetMesh& mesh, int axis, double at);

double root_mean_square(std::span<const double> errors);

}  // namespace terratet::testing
