// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where faults' triangles are too large for what is near them.

#include <array>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/barrier/complex/sheet_mesher.hpp"
#include "tess/base/poll.hpp"
#include "tess/base/size_field.hpp"

namespace terratet {

/// Triangles whose sides nothing but the seeds' spacing decides: not at a junction or rim, nor next to one.
std::vector<char> inner_triangles(const SheetComplex& complex, const EdgeTable& edges);

/// A triangle's centroid, for the sake of its own surface.
FinerPlace place_of(const SheetComplex& complex, std::uint32_t t);

/// Where two triangles cross, the one and the other.
std::vector<FinerPlace> crossing_places(const SheetComplex& complex,
                                        const std::vector<std::array<std::uint32_t, 2>>& pairs);

/// Triangles that the seeds of another surface come too near to for their size. An edge from such a seed, d away, to a
/// vertex at least r_p away on the other side lies in an empty ball whose section with the sheet has a radius of
/// √(d r_p) or more about the crossing: no such section is free of the sheet's own seeds where its triangles are
/// smaller than about 1.1 √(s d). Seeds of the junction itself
/// don't count, nor do those of one of the `walls`, by surface, for another: edges over their corners harm nothing.
std::vector<FinerPlace> crowded_places(const SheetComplex& complex, const std::vector<std::vector<Seed>>& seeds,
                                       const SizeField& sizes, const std::vector<char>& walls, const Poll& poll = {});

}  // namespace terratet
