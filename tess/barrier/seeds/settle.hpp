// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The seeds of exact mode, made to stand in general position.
///
/// All seeds round a corner of the sheet lie on one sphere, so that rounding decides how they are tessellated. On each
/// side of a sheet that hardly bends they all but lie in a plane as well, and a cell between four of one side has no
/// height. Such cells do not come about where each seed stands a little deeper in the ball the farther it is from the
/// sheet: the depths of one side are then those of a plane, above which the other side's lie (they are lifted by a
/// concave function, which a cell of one side alone would have to be below).

#include <array>
#include <span>
#include <vector>

#include "tess/barrier/complex/sheet_complex.hpp"

namespace terratet {

/// A triangle's seeds stand that high over the foot, on both sides; 0: it has none.
struct BallPair {
    Vec3 foot;
    double height = 0;
};

/// Where to put those of the triangles `of`, + first: nearer to their corners than the ball's radius, or farther, by at
/// most `depth` radii, and less where the seeds are low, so that the wall between them stays within 5 depths of the
/// sheet. `pairs` by triangle; `among`: all triangles that share a corner with one of them. O(n log n).
/// \pre All `of` have a pair.
std::vector<std::array<Vec3, 2>> settled_seeds(const SheetComplex& complex, std::span<const double> radii,
                                               std::span<const BallPair> pairs, double depth,
                                               std::span<const std::uint32_t> of, std::span<const std::uint32_t> among);

}  // namespace terratet
