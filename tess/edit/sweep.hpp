// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which of many places are near: by sweeping, so that a verification owes nothing to the trees it verifies.

#include <algorithm>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// Places sorted by x, for distance questions.
class Sweep {
  public:
    explicit Sweep(std::vector<Vec3> points) : points_(std::move(points)) { std::ranges::sort(points_); }

    [[nodiscard]] bool contains(const Vec3& p) const { return std::ranges::binary_search(points_, p); }

    /// Does the question hold for a point nearer to p than r? p itself is asked as well when it is one of them.
    template <class Question>
    [[nodiscard]] bool any_of(const Vec3& p, double r, const Question& question) const {
        const Vec3 from{p.x - r, -max_coordinate * 10, -max_coordinate * 10};
        for (auto q = std::ranges::lower_bound(points_, from); q != points_.end() && q->x <= p.x + r; ++q) {
            if (squared_distance(*q, p) < r * r && question(*q)) {
                return true;
            }
        }
        return false;
    }

  private:
    std::vector<Vec3> points_;
};

}  // namespace terratet
