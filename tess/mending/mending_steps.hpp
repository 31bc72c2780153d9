// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The steps by which a cut mesh is mended (mend_cells.hpp), found for one bad cell and made.

#include <optional>

#include "tess/mending/mendable_mesh.hpp"

namespace terratet {

/// Cells that go and those that come in their place; or one point that moves.
struct MendingStep {
    std::vector<std::uint32_t> old;
    std::vector<MendableMesh::Cell> fresh;
    std::uint32_t mover = MendableStars::none;
    Vec3 to;
    double worst = 0;  ///< goodness of the worst cell after it
};

/// Of all that touch the cell the one that leaves the best worst cell; nothing where none makes the worst cell
/// concerned better.
std::optional<MendingStep> best_change(MendableStars& stars, std::uint32_t cell);

/// The best way for one of the cell's short edges to vanish; nothing where each leaves a cell worse than the worst
/// concerned and than `enough`.
std::optional<MendingStep> best_shortening(MendableStars& stars, std::uint32_t cell, double enough);

void make(MendableStars& stars, const MendingStep& change);

}  // namespace terratet
