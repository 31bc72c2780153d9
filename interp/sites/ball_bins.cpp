// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/ball_bins.hpp"

#include <algorithm>
#include <cmath>

namespace terratet {
namespace {

constexpr double bins_wanted = 1 << 17;
constexpr double bins_max = 512;  // along an axis
constexpr double hair = 1e-8;     // of the squared radius

}  // namespace

BallBins::BallBins(const Box3& box, std::vector<Ball> balls) : box_(box), balls_(std::move(balls)) {
    const Vec3 size = box.size();
    const double longest = std::max({size.x, size.y, size.z});
    double edge = longest > 0 ? longest / std::cbrt(bins_wanted) : 1;
    const auto along = [&](double extent) { return std::clamp(std::ceil(extent / edge), 1.0, bins_max); };
    for (int i = 0; i < 40 && along(size.x) * along(size.y) * along(size.z) < bins_wanted / 2; ++i) {
        edge *= 0.7;
    }
    std::size_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        bins_[a] = static_cast<std::int32_t>(along(size[axis]));
        edge_[a] = size[axis] / bins_[a];
        count *= static_cast<std::size_t>(bins_[a]);
    }
    states_.assign(count, 0);
    for (Ball& ball : balls_) {
        ball.squared_radius *= 1 + hair;
    }
    std::ranges::sort(balls_, std::greater(), &Ball::squared_radius);  // large ones fill bins that others leave alone
    for (std::uint32_t i = 0; i < balls_.size(); ++i) {
        add(i);
    }
}

std::int32_t BallBins::bin_of(int axis, double at) const {
    const auto a = static_cast<std::size_t>(axis);
    const double bin = edge_[a] > 0 ? (at - box_.lo[axis]) / edge_[a] : 0;
    return static_cast<std::int32_t>(std::clamp(bin, 0.0, bins_[a] - 1.0));
}

void BallBins::add(std::uint32_t index) {
    const Ball& ball = balls_[index];
    const double radius = std::sqrt(ball.squared_radius);
    struct Slab {
        double nearest, farthest;  ///< squared distances along the axis from the centre
    };
    thread_local std::array<std::vector<Slab>, 3> slabs;
    std::array<std::int32_t, 3> first{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const double at = ball.center[axis];
        if (at + radius < box_.lo[axis] || at - radius > box_.hi[axis]) {
            return;
        }
        first[a] = bin_of(axis, at - radius);
        const std::int32_t last = bin_of(axis, at + radius);
        slabs[a].clear();
        // A bin ends where rounding lets the next one begin: a hair is given to both.
        for (std::int32_t i = first[a]; i <= last; ++i) {
            const double lo = box_.lo[axis] + (i - hair) * edge_[a] - at, hi = lo + (1 + 2 * hair) * edge_[a];
            const double away = std::max({lo, 0.0, -hi}), beyond = std::max(-lo, hi);
            slabs[a].push_back({away * away, beyond * beyond});
        }
    }
    for (std::size_t x = 0; x < slabs[0].size(); ++x) {
        for (std::size_t y = 0; y < slabs[1].size(); ++y) {
            const double near_xy = slabs[0][x].nearest + slabs[1][y].nearest;
            if (near_xy > ball.squared_radius) {
                continue;
            }
            const double far_xy = slabs[0][x].farthest + slabs[1][y].farthest;
            std::size_t bin = (static_cast<std::size_t>(first[0]) + x) * static_cast<std::size_t>(bins_[1]);
            bin = (bin + static_cast<std::size_t>(first[1]) + y) * static_cast<std::size_t>(bins_[2]);
            bin += static_cast<std::size_t>(first[2]);
            for (std::size_t z = 0; z < slabs[2].size(); ++z, ++bin) {
                std::uint32_t& state = states_[bin];
                if (state == whole || near_xy + slabs[2][z].nearest > ball.squared_radius) {
                    continue;
                }
                if (far_xy + slabs[2][z].farthest <= ball.squared_radius) {
                    state = whole;
                    continue;
                }
                if (state == 0) {
                    state = static_cast<std::uint32_t>(lists_.size()) + 2;
                    lists_.emplace_back();
                }
                lists_[state - 2].push_back(index);
            }
        }
    }
}

bool BallBins::contains(const Vec3& p) const {
    std::size_t bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
        bin = bin * static_cast<std::size_t>(bins_[static_cast<std::size_t>(axis)]) +
              static_cast<std::size_t>(bin_of(axis, p[axis]));
    }
    const std::uint32_t state = states_[bin];
    return state == whole || (state != 0 && std::ranges::any_of(lists_[state - 2], [&](std::uint32_t i) {
                                  return squared_distance(p, balls_[i].center) <= balls_[i].squared_radius;
                              }));
}

}  // namespace terratet
