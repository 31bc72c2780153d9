// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The Voronoi diagram of a tessellation's vertices.

#include "tess/progress.hpp"
#include "tess/tet_mesh.hpp"
#include "tess/voronoi/voronoi_complex.hpp"

namespace terratet {

/// The dual of a Delaunay mesh: a cell a point, a wall an edge, a corner a circumcentre. What meets in what is read off
/// the mesh, so exact predicates have decided it. Neighbouring circumcentres are one corner where an exact predicate
/// finds their points on one sphere: the cells of a lattice are boxes. Circumcentres are right to 1e-13 radii, however
/// flat the cell.
///
/// What is unbounded ends about ten diagonals away from the mesh, in walls with beyond_bound. O(n).
VoronoiComplex voronoi_dual(const TetMesh& mesh, const Poll& poll = {});

}  // namespace terratet
