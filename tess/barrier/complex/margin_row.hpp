// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A row of triangles beyond the free rims of a fault complex, joined to it.

#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/barrier/complex/sheet_wall.hpp"
#include "tess/frame.hpp"

namespace terratet {

/// The complex with one row more, appended after its own points and triangles: an equilateral triangle on each rim
/// edge, and between neighbouring ones as many as the angle asks for. Places nearer than `clear` edge lengths to
/// another surface, or hidden by one, get none, nor do rims farther than `width` from the extent. Points are snapped to
/// the frame.
SheetComplex with_margin_row(const SheetComplex& complex, const EdgeTable& edges, const SheetWall& wall, double clear,
                             const Box3& extent, double width, const Frame& frame);

}  // namespace terratet
