// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The cells of a large tessellation near a place, from the vertices round it alone: what lies in a tile and its halo
/// is tessellated, and the halo grows until nothing beyond it can have a part in the tile. Sound because the Delaunay
/// tessellation of a set of points is unique here, ties included: a cell whose closed circumball holds no other vertex
/// of the whole set is one of the whole tessellation (the local half of Tile & Merge: Caraffa, Memari, Yirci, Brédif
/// 2019, "Tile & merge: distributed Delaunay triangulations for cloud computing").

#include <cstddef>
#include <functional>
#include <vector>

#include "tess/geometry.hpp"
#include "tess/progress.hpp"
#include "tess/tet_mesh.hpp"

namespace terratet {

/// All vertices in a closed box, ids ascending.
using VerticesIn = std::function<std::vector<Vertex>(const Box3& box)>;

struct Tile {
    std::vector<Vertex> vertices;  ///< of the tile and its halo
    TetMesh mesh;                  ///< of them; cells are those that may meet the tile, without neighbours
    Box3 read;                     ///< the tile with its halo
    int grown = 0;                 ///< how often the halo was doubled
};

/// Guarantee S1: the cells whose closed circumballs lie in the halo, or beyond the hull where nothing is, are cells of
/// the whole tessellation, and they cover the tile. Every cell that is returned is one of those, and every cell of the
/// whole that shares inner points with the tile is returned. Circumballs are bounded by interval arithmetic.
/// \param halo  to begin with, > 0; three or four times the vertices' spacing seldom grows
/// \param hull  holds all vertices, and its eight corners are vertices
Tile tessellate_tile(const Box3& tile, const Box3& hull, double halo, const VerticesIn& vertices_in,
                     const Poll& poll = {});

}  // namespace terratet
