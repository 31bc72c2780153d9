// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What a finer l_min between samples would let in, before it is tried.

#include <cstdint>
#include <vector>

#include "tess/mesh/delaunay.hpp"
#include "tess/refine/insertion_rule.hpp"

namespace terratet {

struct CoarseCells {
    std::vector<delaunay::Cell> cells;    ///< which l_min alone had refused a vertex, and would no longer
    std::uint64_t vertices_expected = 0;  ///< that these would take
    double varying_volume = 0;            ///< of cells that may be off, and at most twice as small as l_min allows
};

/// \param next  the finer l_min. Linear in the cells.
CoarseCells coarse_cells(const delaunay::Core& core, const InsertionRule& rule, const Box3& hull, double next);

}  // namespace terratet
