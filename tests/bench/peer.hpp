// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Other mesh generators on the same task: fill a box with tetrahedra of a size, with given points among their
/// vertices. Each runs on one thread and reports the CPU time from its own input structures to its own mesh.

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "tess/mesh/quality.hpp"

namespace terratet::bench {

struct PointsInBox {
    Box3 box;
    std::vector<Vec3> points;
};

/// What a generator made of it.
struct MeshResult {
    double seconds = 0;
    std::size_t vertices = 0;
    std::size_t cells = 0;
    double longest_edge = 0;
    double dihedral_p1_deg = 0;  ///< 1 % of the cells have a smaller dihedral angle
    double sharp_percent = 0;    ///< of the cells have one below 5°
};

/// `corners(c)` are the points of cell c.
template <typename Corners>
MeshResult measured(double seconds, std::size_t vertices, std::size_t cells, const Corners& corners) {
    MeshResult result{seconds, vertices, cells, 0, 0, 0};
    std::vector<double> angles(cells);
    for (std::size_t c = 0; c < cells; ++c) {
        const CellQuality quality = cell_quality(corners(c));
        angles[c] = quality.dihedral_min_deg;
        result.longest_edge = std::max(result.longest_edge, quality.longest_edge);
    }
    std::ranges::sort(angles);
    result.dihedral_p1_deg = angles[cells / 100];
    result.sharp_percent = 100.0 * static_cast<double>(std::ranges::lower_bound(angles, 5.0) - angles.begin()) /
                           static_cast<double>(cells);
    return result;
}

/// TetGen: cells up to `volume` and R/ℓ up to `radius_edge`; `more` are further switches, "O0o/180" for no
/// optimisation.
MeshResult tetgen(const PointsInBox& task, double volume, double radius_edge, const char* more);

/// CGAL's Mesh_3, R/ℓ up to 2, circumradii up to `size`, with its optimisers as they are by default
/// (perturbation and exudation), or without. The box only: it takes no points. With more than one thread its seconds
/// are those of the clock on the wall.
MeshResult mesh_3(const PointsInBox& task, double size, bool optimise, int threads);

/// Gmsh's Delaunay algorithm with the points embedded, edges of about `size`, with its optimiser as it is by default,
/// or without. In a process of its own (gmsh_peer), since Gmsh's library brings a TetGen of its own along. Nothing when
/// that fails.
std::optional<MeshResult> gmsh(const PointsInBox& task, double size, bool optimise);

}  // namespace terratet::bench
