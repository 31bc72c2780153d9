// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Points, for questions of one fixed radius: is there one within r?

#include "tess/base/grid.hpp"

namespace terratet {

class PointGrid {
  public:
    explicit PointGrid(double radius) : grid_(radius) {}

    void insert(const Vec3& p) { grid_.insert(p, p); }

    /// Is some inserted point nearer to p than `distance`? \pre distance ≤ the grid's radius.
    [[nodiscard]] bool any_within(const Vec3& p, double distance) const {
        return grid_.any_near(p, [&](const Vec3& q) { return squared_distance(p, q) < distance * distance; });
    }

    /// Squared distance to the nearest inserted point, or `limit` when none is nearer. \pre limit ≤ radius².
    [[nodiscard]] double nearest_squared(const Vec3& p, double limit) const {
        grid_.visit(p, [&](const Vec3& q) { limit = std::min(limit, squared_distance(p, q)); });
        return limit;
    }

  private:
    Grid<Vec3> grid_;
};

}  // namespace terratet
