// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The nearest of many points, by number, within one radius.

#include <limits>
#include <span>

#include "tess/base/grid.hpp"
#include "tess/base/no_index.hpp"

namespace terratet {

class SeedGrid {
  public:
    SeedGrid(std::span<const Vec3> points, double radius) : grid_(radius) {
        for (const Vec3& p : points) {
            insert(p);
        }
    }

    /// Numbers count up from 0.
    void insert(const Vec3& p) {
        grid_.insert(p, static_cast<std::uint32_t>(points_.size()));
        points_.push_back(p);
    }

    /// The nearest one within the radius, the first of equals; none when none is.
    [[nodiscard]] std::uint32_t nearest(const Vec3& p) const {
        std::uint32_t best = no_index;
        double least = radius() * radius();
        visit(p, [&](std::uint32_t i) {
            const double d = squared_distance(points_[i], p);
            if (d < least || (d == least && i < best)) {
                least = d;
                best = i;
            }
        });
        return best;
    }

    /// Calls with the number of every point within the radius of p, and of some beyond.
    template <class Visit>
    void visit(const Vec3& p, const Visit& call) const {
        grid_.visit(p, call);
    }

    [[nodiscard]] const Vec3& point(std::uint32_t i) const { return points_[i]; }
    [[nodiscard]] double radius() const { return grid_.radius(); }

  private:
    std::vector<Vec3> points_;
    Grid<std::uint32_t> grid_;
};

}  // namespace terratet
