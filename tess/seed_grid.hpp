// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Internal: the nearest of many points, by number, within one radius.

#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

class SeedGrid {
  public:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    SeedGrid(std::span<const Vec3> points, double radius) : radius_(radius) {
        for (const Vec3& p : points) {
            insert(p);
        }
    }

    /// Numbers count up from 0.
    void insert(const Vec3& p) {
        cells_[key(index(p))].push_back(static_cast<std::uint32_t>(points_.size()));
        points_.push_back(p);
    }

    /// The nearest one within the radius, the first of equals; none when none is.
    [[nodiscard]] std::uint32_t nearest(const Vec3& p) const {
        std::uint32_t best = none;
        double least = radius_ * radius_;
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
        const Index centre = index(p);
        visit_cells({centre[0] - 1, centre[1] - 1, centre[2] - 1}, {centre[0] + 1, centre[1] + 1, centre[2] + 1}, call);
    }

    [[nodiscard]] const Vec3& point(std::uint32_t i) const { return points_[i]; }
    [[nodiscard]] double radius() const { return radius_; }

  private:
    using Index = std::array<std::int64_t, 3>;

    template <class Visit>
    void visit_cells(const Index& lo, const Index& hi, const Visit& call) const {
        for (std::int64_t i = lo[0]; i <= hi[0]; ++i) {
            for (std::int64_t j = lo[1]; j <= hi[1]; ++j) {
                for (std::int64_t k = lo[2]; k <= hi[2]; ++k) {
                    if (const auto cell = cells_.find(key({i, j, k})); cell != cells_.end()) {
                        for (const std::uint32_t n : cell->second) {
                            call(n);
                        }
                    }
                }
            }
        }
    }

    [[nodiscard]] Index index(const Vec3& p) const {
        return {static_cast<std::int64_t>(std::floor(p.x / radius_)),
                static_cast<std::int64_t>(std::floor(p.y / radius_)),
                static_cast<std::int64_t>(std::floor(p.z / radius_))};
    }
    static std::uint64_t key(const Index& i) {
        constexpr std::uint64_t mask = (1U << 21U) - 1;  // wraps for a continent at millimetres: costs time only
        return (static_cast<std::uint64_t>(i[0]) & mask) << 42U | (static_cast<std::uint64_t>(i[1]) & mask) << 21U |
               (static_cast<std::uint64_t>(i[2]) & mask);
    }

    double radius_;
    std::vector<Vec3> points_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace terratet
