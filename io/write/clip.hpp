// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The tessellation cut exactly at the extent's six planes. Cells that reach beyond are cut
/// into tetrahedra, conforming: a quadrilateral shared by two pieces is split along the diagonal from its smallest
/// point (by coordinates, so that the twin facets of a collapsed fault are cut alike), which also settles every prism
/// (Dompierre et al. 1999, How to subdivide pyramids, prisms and hexahedra into tetrahedra). Cells are cut anywhere,
/// so that many pieces are needles and slivers; these are mended (tess/mending/mend_cells.hpp): points near a plane go
/// onto it, cells are turned and points moved until none is sharp that need not be. The volumes add up to that of the
/// extent within rounding.

#include "io/write/clipped_mesh.hpp"

namespace terratet {

enum class ClippedCells {
    as_cut,  ///< where shapes do not matter: volumes
    mended,
};

/// O(cells).
ClippedMesh clip_to_extent(const ModelView& view, ClippedCells cells = ClippedCells::mended,
                           const Progress& progress = {});

/// O(cells).
ClippedShapes clipped_shapes(const ModelView& view, const ClippedMesh& mesh);

}  // namespace terratet
