// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where a model ends within its extent: at the ground, and at its outline in plan.

#include "tess/barrier_query.hpp"
#include "tess/domain.hpp"

namespace terratet {

class ModelBounds {
  public:
    /// \pre `faults` outlives this.
    ModelBounds(const Domain& domain, const BarrierQuery& barriers) : outline_(domain.outline), barriers_(barriers) {}

    /// Above the ground, or beyond the outline: nothing is modelled there. Says nothing of the extent.
    [[nodiscard]] bool excludes(const Vec3& p) const { return !outline_.contains(p) || is_above_ground(barriers_, p); }

  private:
    Outline outline_;
    const BarrierQuery& barriers_;
};

}  // namespace terratet
