// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Sheets that cross, abut or nearly abut, cut along their intersections into one complex.

#include <cstdint>
#include <optional>
#include <vector>

#include "tess/barrier/complex/sheet_complex.hpp"
#include "tess/base/poll.hpp"

namespace terratet {

/// A connected manifold piece of a surface.
struct Sheet {
    TriMesh mesh;
    std::uint32_t surface = 0;  ///< the surface it is of, in the caller's numbering: its number in the complex
};

struct CutSheets {
    SheetComplex complex;                  ///< points rounded to double; coincident ones are one
    std::vector<double> trimmed;           ///< area of stubs and coplanar overlaps dropped, by surface
    std::optional<std::uint32_t> tangled;  ///< a surface that meets others too often to be cut; then no complex is made
};

/// Moves rim points that stop short of another sheet, or poke through it, by no more than `tolerance`, to end a little
/// beyond it, so that the cut is clean. Where the rim meets the other sheet at less than 20° (a move along it would
/// make a sliver) or the move would fold the sheet, points stay. Moved points: the return value.
std::size_t extend_to_neighbours(std::vector<Sheet>& sheets, double tolerance, const Poll& poll = {});

/// Cuts all sheets along their intersections: an arrangement of triangles in exact arithmetic (after Zhou et al., ACM
/// Trans. Graph. 35, 2016), in which every point is the meeting of the triangles as read, whatever else meets there, so
/// that it comes out the same in each. Rounds, welds equal points, and drops stubs: pieces with a free rim all of which
/// lies within `tolerance` of a junction. Where sheets overlap in one plane, the first keeps the overlap.
/// Deterministic. About 0.2 ms a pair of triangles that meet.
CutSheets cut_sheets(const std::vector<Sheet>& sheets, std::uint32_t surface_count, double tolerance,
                     const Poll& poll = {});

}  // namespace terratet
