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
    std::uint32_t mover = no_index;
    Vec3 to;
    double by = 0;  ///< what it is chosen by: the higher the better
};

/// What makes one change better than another.
enum class MendingAim {
    worst,     ///< the worst of the cells concerned is as good as can be,
    together,  ///< or they are together, weighed so that the worst counts most: that one of them cannot be mended does
               ///< not keep the others from it
};

/// The best of all that touch the cell; nothing where none makes the cells concerned better by a twentieth.
std::optional<MendingStep> best_change(MendableStars& stars, std::uint32_t cell, MendingAim aim);

/// The best way for one of the cell's short edges to vanish; nothing where each leaves a cell worse than the worst
/// concerned and than `enough`.
std::optional<MendingStep> best_shortening(MendableStars& stars, std::uint32_t cell, double enough);

void make(MendableStars& stars, const MendingStep& change);

}  // namespace terratet
