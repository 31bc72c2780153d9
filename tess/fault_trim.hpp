// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Internal: keeping faults apart. In paired mode a fault's seeds are as foreign to its neighbour as any other vertex:
/// they must stay out of its protection zone, and its own surface out of theirs.

#include <string>
#include <vector>

#include "tess/fault.hpp"
#include "tess/fault_mesh.hpp"

namespace terratet {

/// What may stay of a fault beside those accepted before it.
struct TrimmedFault {
    FaultMesh sheet;      ///< within the extent, with all of its margin in place
    FaultMesh margin;     ///< the rest that stays
    std::string nearest;  ///< name of the accepted fault that took most; empty when nothing was taken
};

/// Drops what is nearer to an accepted fault than the two can stand, then demotes to margin what would be nearer than
/// `margin_width` to a gap so made. `sheet` lies within the extent, `around` beyond it or is skirt.
TrimmedFault trim_beside(const FaultMesh& sheet, const FaultMesh& around, const std::vector<Fault>& accepted,
                         double protection_radius, double width, double margin_width);

}  // namespace terratet
