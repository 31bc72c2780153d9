// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How many vertices the criteria ask for, known before any is made.

#include "tess/build_options.hpp"

namespace terratet {

/// From below: a model takes no fewer. Counts, not whole numbers, since they may be astronomical.
struct VertexDemand {
    double edges = 0;  ///< for cells of l_max, or of v_max: volume over that of a regular cell, and 6.8 cells a vertex
    double grid = 0;   ///< on the hull box' faces
    double seeds = 0;  ///< of faults in the extent: two for each square of the spacing

    [[nodiscard]] double total() const;
};

/// \pre extent and criteria are resolved. Criteria by which cells may be smooth ask for nothing by l_max.
VertexDemand vertex_demand(const Model& model, const BarrierOptions& barriers);

/// Throws UsageError when that is more than options.refine.max_vertices, naming the option to change and a value.
void require_affordable(const Model& model, const BuildOptions& options);

}  // namespace terratet
