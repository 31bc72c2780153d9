// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The sharp cells of a collapsed mesh get better shapes (mend_cells.hpp).

#include "tess/collapsed_model.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// Samples, seeds and the points of faults, ground and walls
/// stay where they are; other vertices may move, and then have the linear field's values and new ids, or vanish: nodes
/// that no cell has are left behind. Cells beyond the ground or the outline and in gaps that are kept stay as they are.
/// O(n log n).
void mend_collapsed(CollapsedModel& collapsed, const Progress& progress = {});

}  // namespace terratet
