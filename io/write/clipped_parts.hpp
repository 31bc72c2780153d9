// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What is done to a mesh once it is cut at the extent's planes.

#include "io/write/clipped_mesh.hpp"

namespace terratet {

/// Of an edge with a fault across it, as there are some beyond the extent, a cut has the value of the end on its own
/// side: its t is set to 0 or 1.
/// \param points of all places
void keep_to_own_sides(const ModelView& view, std::span<const Vec3> points, std::vector<ClippedMesh::Cut>& cuts);

/// The cells that were cut get better shapes (tess/mending/mend_cells.hpp). Samples and seeds stay where they are, as
/// do the sheets of faults, but that where a sheet meets the extent its facets may end at other points of it. Points
/// that are moved become places of their own. Facets are not kept up.
void mend_clipped(const ModelView& view, ClippedMesh& mesh, const Progress& progress);

/// Of all resolutions that are asked for.
double smallest_l_min(const Criteria& criteria);

/// Leaves out the points that no cell uses.
void drop_unused_points(ClippedMesh& mesh);

}  // namespace terratet
