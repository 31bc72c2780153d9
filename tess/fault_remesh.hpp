// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Internal: a fault complex remeshed to the seeds' spacing, all sheets at once, so that junctions stay conforming.

#include "tess/fault_complex.hpp"
#include "tess/size_field.hpp"

namespace terratet {

struct RemeshReport {
    std::size_t splits = 0;
    std::size_t collapses = 0;
    std::size_t flips = 0;
    std::size_t snaps = 0;                                ///< points merged into a sheet they nearly touched
    std::vector<std::array<std::uint32_t, 2>> crossings;  ///< left over: triangles of the result
    double least_wedge = 0;                               ///< radians; of the result
};

/// Near-equilateral triangles of the wanted edge length (split above 4/3 of it, collapse below 0.7, Delaunay flips,
/// points centred and projected back; after Botsch and Kobbelt 2004, carried over to edges with any number of
/// triangles). Points nearer than `snap` edge lengths to a sheet they do not belong to are merged into it, which zips
/// wedges below about 15°; rounds of that follow until no triangles cross and no wedge is below 10°, or nothing helps.
/// Deterministic. About 0.3 ms a point.
FaultComplex remeshed(const FaultComplex& complex, const SizeField& sizes, double snap, RemeshReport& report);

}  // namespace terratet
