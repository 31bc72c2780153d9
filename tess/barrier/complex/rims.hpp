// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The free rims of barriers, and how near a line of sight passes by them.

#include <array>
#include <vector>

#include "tess/base/box_tree.hpp"
#include "tess/base/slab.hpp"
#include "tess/geometry.hpp"

namespace terratet {

/// An edge's two ends.
using EdgePlace = std::array<Vec3, 2>;

/// Of one barrier.
class FreeRims {
  public:
    FreeRims() = default;

    /// \param spacing  of the barrier, the unit of distances from them; rims are left out where it is 0
    /// \param normal   of the barrier's mean plane, which the rims are near to. O(n log n).
    FreeRims(const std::vector<EdgePlace>& rims, double spacing, const Vec3& normal);

    /// The segment's distance from the nearest rim in units of the spacing, but at most `least`, itself at most 1.
    /// O(log n) far from rims.
    [[nodiscard]] double clearance(const Vec3& a, const Vec3& b, double least = 1) const;

  private:
    BoxTree<EdgePlace> tree_;  ///< boxes grown by the spacing
    double spacing_ = 0;
    Slab slab_{{}, {}};
};

/// Between two closed segments (Ericson, Real-Time Collision Detection, 5.1.9).
double segment_distance(const Vec3& p1, const Vec3& q1, const Vec3& p2, const Vec3& q2);

}  // namespace terratet
