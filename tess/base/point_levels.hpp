// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Points, for questions of any radius: is there one within r? A grid for each octave of radii that is asked for.

#include <cmath>
#include <map>
#include <vector>

#include "tess/base/point_grid.hpp"

namespace terratet {

class PointLevels {
  public:
    void insert(const Vec3& p) {
        points_.push_back(p);
        for (auto& [level, grid] : grids_) {
            grid.insert(p);
        }
    }

    /// Is some inserted point nearer to p than `distance`?
    [[nodiscard]] bool any_within(const Vec3& p, double distance) {
        const int level = static_cast<int>(std::ceil(std::log2(distance)));
        const auto [found, fresh] = grids_.try_emplace(level, std::exp2(level));
        if (fresh) {
            for (const Vec3& q : points_) {
                found->second.insert(q);
            }
        }
        return found->second.any_within(p, distance);
    }

  private:
    std::vector<Vec3> points_;
    std::map<int, PointGrid> grids_;
};

}  // namespace terratet
