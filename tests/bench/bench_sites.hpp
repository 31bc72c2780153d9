// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The two kinds of sites every benchmark measures on, and the clock.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "support.hpp"

namespace terratet::bench {

inline constexpr double side = 1000;

inline std::vector<Vec3> uniform_sites(std::size_t count, std::uint64_t seed = 1) {
    testing::Random random(seed);
    std::vector<Vec3> sites(count);
    for (auto& p : sites) {
        p = random.in({{0, 0, 0}, {side, side, side}});
    }
    return sites;
}

/// Nearly vertical wells with a sample every side/samples, jittered a little as surveys are.
inline std::vector<Vec3> borehole_sites(std::size_t wells, std::size_t samples, std::uint64_t seed = 1) {
    testing::Random random(seed);
    const auto gauss = [&] {
        return std::sqrt(-2 * std::log(1 - random())) * std::cos(2 * std::numbers::pi * random());
    };
    std::vector<Vec3> sites;
    const double step = side / static_cast<double>(samples);
    for (std::size_t w = 0; w < wells; ++w) {
        const Vec3 collar{random(0, side), random(0, side), side};
        const Vec3 lean{0.02 * gauss(), 0.02 * gauss(), -1};
        for (std::size_t i = 0; i < samples; ++i) {
            const Vec3 jitter{0.05 * gauss(), 0.05 * gauss(), 0.1 * step * gauss()};
            sites.push_back(collar + (static_cast<double>(i) + 0.5) * step * lean + jitter);
        }
    }
    return sites;
}

inline double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Median seconds of `repeats` calls.
template <typename Work>
double median_seconds(int repeats, Work work) {
    std::vector<double> seconds;
    for (int i = 0; i < repeats; ++i) {
        const double start = now_s();
        work();
        seconds.push_back(now_s() - start);
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
}

}  // namespace terratet::bench
