// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A line of sight, a closed segment, that asks many boxes whether it misses them.

#include <cmath>

#include "tess/geometry.hpp"

namespace terratet {

class Sight {
  public:
    Sight(const Vec3& a, const Vec3& b)
        : middle_(0.5 * (a + b)),
          half_(0.5 * (b - a)),
          reach_{std::abs(half_.x), std::abs(half_.y), std::abs(half_.z)},
          rounding_(1e-14 *
                    (std::abs(a.x) + std::abs(a.y) + std::abs(a.z) + std::abs(b.x) + std::abs(b.y) + std::abs(b.z))) {}

    /// True only where the segment has no point in the box: rounding errs towards false. Separating axes (Ericson,
    /// Real-Time Collision Detection, 5.3.3). \pre the box is not empty
    [[nodiscard]] bool misses(const Box3& box) const {
        const Vec3 m = middle_ - box.center();
        const Vec3 e = 0.5 * box.size();
        const double slack = rounding_ + 1e-14 * (std::abs(box.lo.x) + std::abs(box.lo.y) + std::abs(box.lo.z) +
                                                  std::abs(box.hi.x) + std::abs(box.hi.y) + std::abs(box.hi.z));
        const double x = e.x + slack, y = e.y + slack, z = e.z + slack;
        return std::abs(m.x) > x + reach_.x || std::abs(m.y) > y + reach_.y || std::abs(m.z) > z + reach_.z ||
               beyond(m.y * half_.z, m.z * half_.y, y * reach_.z + z * reach_.y) ||
               beyond(m.z * half_.x, m.x * half_.z, x * reach_.z + z * reach_.x) ||
               beyond(m.x * half_.y, m.y * half_.x, x * reach_.y + y * reach_.x);
    }

  private:
    static bool beyond(double p, double q, double reach) {
        return std::abs(p - q) > reach + 1e-14 * (std::abs(p) + std::abs(q));
    }

    Vec3 middle_, half_, reach_;
    double rounding_;
};

}  // namespace terratet
