// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Better cells where planes or surfaces have cut a mesh. Hill-climbing (Freitag and Ollivier-Gooch 1997, Tetrahedral
/// mesh improvement using swapping and smoothing): points meet, edges and facets are flipped, points move, each only
/// where the worst of the cells concerned gets better, and in turn where these do together. Every step replaces cells
/// by others of positive volume with the same outer facets, so the mesh fills what it filled: the box and the surfaces
/// stay as they are, but that facets on a surface may follow it by other points of it.

#include "tess/mending/mendable_mesh.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// Mends the touched cells. Points that no cell has any more are left behind; those that moved are marked. Of the same
/// mesh always the same; O(n) and some 100 µs a bad cell. The stage is "mend cells".
void mend_cells(MendableMesh& mesh, const Progress& progress = {});

}  // namespace terratet
