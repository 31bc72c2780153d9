// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What bars estimation: the faults' sheets, for some properties the horizons' too, and beyond the extent what goes on
/// from them (DESIGN §4.4). A sheet ends where it was cut, at the extent's faces, and a rim there is no end of the
/// fault: values that leaked in round it would mix its sides in the margin of the hull box, and so at the faces.
///
/// From each rim on a face of the extent, or where a sheet ends at the ground or at a wall of the domain, rows of
/// triangles lead on: along the surface as it was read as far as that goes, straight on from there, past the box that
/// holds hull box and samples. Where sheets meet in the rim they go on together, along the line in which they meet.
/// What goes straight on ends at what it would cross. Any other rim is a fault's end, and stays it.

#include <span>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/barrier/complex/rims.hpp"
#include "tess/domain.hpp"
#include "tess/site.hpp"

namespace terratet {

/// What bars estimation of a fault.
struct EstimationBarrier {
    bool bars = false;            ///< its sheet does, and the rest counts
    Surface beyond;               ///< what goes on from the sheet
    std::vector<EdgePlace> rims;  ///< free ones, of both
};

/// In step with the faults.
struct EstimationBarriers {
    std::vector<EstimationBarrier> soft;  ///< for most properties
    std::vector<EstimationBarrier> hard;  ///< for those that horizons bar; empty: for none
    std::vector<bool> hard_for;           ///< of each property
    Box3 covered;                         ///< nothing of what goes on from a sheet is inside; empty: it may be anywhere
};

/// Sheets of faults alone, ending where they end.
EstimationBarriers sheets_as_barriers(std::span<const Barrier> barriers);

/// Of a site's faults, prepared within the domain. O(triangles), and a few hundred rows from each rim where a surface
/// goes on beyond the extent.
EstimationBarriers estimation_barriers(const Site& site, const Domain& domain, std::span<const Barrier> barriers);

}  // namespace terratet
