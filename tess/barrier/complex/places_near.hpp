// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which samples ask for smaller triangles on the faults near them.

#include <span>
#include <vector>

#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/barrier/complex/sheet_mesher.hpp"

namespace terratet {

/// Where the complex wants triangles how small, down to an eighth of the spacing, that each sample nearer to it than
/// r_p may stay.
std::vector<WantedSize> places_near(std::span<const Vec3> samples, const SheetComplex& complex, double spacing);

}  // namespace terratet
