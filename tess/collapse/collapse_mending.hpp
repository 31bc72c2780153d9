// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The sharp cells of a collapsed mesh get better shapes (mend_cells.hpp).

#include <span>

#include "tess/barrier_query.hpp"
#include "tess/collapsed_model.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// Samples and the points of faults, ground and walls stay where they are, and seeds but those that `loose` names, by
/// node: of exact faults, which stand beside these and hold nothing any more. Other vertices may move, and then have
/// the linear field's values and new ids, or vanish: nodes that no cell has are left behind. Cells beyond the ground or
/// the outline and in gaps that are kept stay as they are. O(n log n).
void mend_collapsed(CollapsedModel& collapsed, const BarrierQuery& barriers, std::span<const char> loose,
                    const Progress& progress = {});

}  // namespace terratet
