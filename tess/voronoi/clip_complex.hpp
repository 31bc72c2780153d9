// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cells cut at the sides of a box.

#include "tess/progress.hpp"
#include "tess/voronoi/voronoi_complex.hpp"

namespace terratet {

/// Leaves what is in the box; cells get walls on its sides. A corner is on one side of a plane or the other for all its
/// walls, and an edge is cut in one place, so that cells stay closed whatever rounding does, and their volumes add up
/// to the box's. Corners nearer to a side than 1e-12 diagonals are on it. O(corners).
VoronoiComplex clipped_to(VoronoiComplex complex, const Box3& box, const Poll& poll = {});

/// Drops points that no wall has; the others keep their order.
void drop_unused_points(VoronoiComplex& complex);

}  // namespace terratet
