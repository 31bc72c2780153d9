// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A fault's gap filled from the fault's own vertices and the seeds on both sides.
///
/// Where a fault lies on walls of the Voronoi diagram its vertices are vertices of the diagram: the seeds round vertex
/// i lie on one sphere about it, and the cells between them make up a convex polyhedron P_i, triangulated arbitrarily.
/// What is filled in instead is the join of the fault with its dual, as in mixed complexes (Edelsbrunner, Deformable
/// smooth surface design, Discrete Comput. Geom. 21, 1999):
///  - vertex i with each facet of P_i that is no other one's,
///  - edge ij with each edge (a, b) round the facet that P_i and P_j share,
///  - triangle ijk with each of its two seeds.
/// So far as vertices have their node: where j has none, i is joined with the facet that they share as well; where
/// triangle ijk lacks one of its edges, the others are joined with the edge between its seeds.
///
/// As chains the new cells have the boundary of those they replace, whatever the tessellation is like; so when all
/// have a positive volume they tile the same space.

#include <span>

#include "tess/collapse/collapse_nodes.hpp"

namespace terratet {

struct Filling {
    struct Cell {
        std::array<std::uint32_t, 4> corners;  ///< vertices, or their number + the rank among the fault's vertices
        std::uint32_t parent = 0;              ///< one of the replaced cells near it
    };
    std::vector<char> replaced;  ///< by cell of the tessellation
    std::vector<Cell> cells;
};

/// Fills the cells about the fault's vertices that have their node. `nodes` with the vertices last. O(n log n).
Filling fill_gaps(const TetMesh& mesh, std::span<const FaultNode> nodes);

}  // namespace terratet
