// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Rounding what mirrored pairs of seeds could not follow.

#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/base/size_field.hpp"

namespace terratet {

/// Rounds bends sharper than a radius of five edge lengths: points there move along their normals towards their
/// neighbours until every bend is resolved, or for 40 rounds. Points of several sheets stay where they are, and what
/// bends beside them is left. Returns the places that a finer spacing would serve better: still unresolved, or moved by
/// more than a fifth of the edge length.
std::vector<Vec3> round_bends(SheetComplex& complex, const SizeField& sizes);

}  // namespace terratet
