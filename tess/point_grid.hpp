// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A hash grid of points for questions of one fixed radius: is there a point within r? Private to this floor.

#include <unordered_map>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

class PointGrid {
  public:
    explicit PointGrid(double radius) : radius_(radius) {}

    void insert(const Vec3& p) { cells_[key(index(p))].push_back(p); }

    /// Is some inserted point nearer to p than `distance`? \pre distance ≤ the grid's radius.
    [[nodiscard]] bool any_within(const Vec3& p, double distance) const {
        return nearest_squared(p, distance * distance) < distance * distance;
    }

    /// Squared distance to the nearest inserted point, or `limit` when none is nearer. \pre limit ≤ radius².
    [[nodiscard]] double nearest_squared(const Vec3& p, double limit) const {
        const Index centre = index(p);
        for (std::int64_t i = centre[0] - 1; i <= centre[0] + 1; ++i) {
            for (std::int64_t j = centre[1] - 1; j <= centre[1] + 1; ++j) {
                for (std::int64_t k = centre[2] - 1; k <= centre[2] + 1; ++k) {
                    if (const auto cell = cells_.find(key({i, j, k})); cell != cells_.end()) {
                        for (const Vec3& q : cell->second) {
                            limit = std::min(limit, squared_distance(p, q));
                        }
                    }
                }
            }
        }
        return limit;
    }

  private:
    using Index = std::array<std::int64_t, 3>;

    /// Coordinates are at most 1e9: an index needs no more than 21 bits unless the radius is below a millimetre for a
    /// continent; then keys wrap, which only makes buckets larger.
    [[nodiscard]] Index index(const Vec3& p) const {
        return {static_cast<std::int64_t>(std::floor(p.x / radius_)),
                static_cast<std::int64_t>(std::floor(p.y / radius_)),
                static_cast<std::int64_t>(std::floor(p.z / radius_))};
    }
    static std::uint64_t key(const Index& i) {
        constexpr std::uint64_t mask = (1U << 21U) - 1;
        return (static_cast<std::uint64_t>(i[0]) & mask) << 42U | (static_cast<std::uint64_t>(i[1]) & mask) << 21U |
               (static_cast<std::uint64_t>(i[2]) & mask);
    }

    double radius_;
    std::unordered_map<std::uint64_t, std::vector<Vec3>> cells_;
};

}  // namespace terratet
