// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The kinds of sites that tests and benchmarks estimate from.

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support.hpp"
#include "tess/barrier.hpp"

namespace terratet::testing {

inline constexpr double side = 1000;  ///< of the box all of them lie in, about

inline std::vector<Vec3> uniform_sites(std::size_t count, std::uint64_t seed = 1) {
    Random random(seed);
    std::vector<Vec3> sites(count);
    for (auto& p : sites) {
        p = random.in({{0, 0, 0}, {side, side, side}});
    }
    return sites;
}

/// Nearly vertical wells with a sample every side/samples, jittered a little as surveys are.
inline std::vector<Vec3> borehole_sites(std::size_t wells, std::size_t samples, std::uint64_t seed = 1) {
    Random random(seed);
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

/// n³ sites with integer coordinates 0 … n − 1: all cells cospherical with others.
inline std::vector<Vec3> lattice_sites(int n) {
    std::vector<Vec3> sites;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            for (int k = 0; k < n; ++k) {
                sites.push_back({double(i), double(j), double(k)});
            }
        }
    }
    return sites;
}

/// n² sites on a plane, `step` apart.
inline std::vector<Vec3> square_sites(int n, double step) {
    std::vector<Vec3> sites;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            sites.push_back({i * step, j * step, 0});
        }
    }
    return sites;
}

/// All integer points at exactly one distance from the origin: one sphere, and nothing inside.
inline std::vector<Vec3> cospherical_sites(int squared_radius) {
    std::vector<Vec3> sites;
    const int r = static_cast<int>(std::sqrt(squared_radius)) + 1;
    for (int i = -r; i <= r; ++i) {
        for (int j = -r; j <= r; ++j) {
            for (int k = -r; k <= r; ++k) {
                if (i * i + j * j + k * k == squared_radius) {
                    sites.push_back({double(i), double(j), double(k)});
                }
            }
        }
    }
    return sites;
}

/// In a frame in which no axis lies in the plane of x and y, far from the origin.
inline std::vector<Vec3> tilted(std::vector<Vec3> sites) {
    const Vec3 u{2.0 / 3, 2.0 / 3, 1.0 / 3}, v{-2.0 / 3, 1.0 / 3, 2.0 / 3}, w{1.0 / 3, -2.0 / 3, 2.0 / 3};
    for (Vec3& p : sites) {
        p = Vec3{70'000, 50'000, -300} + p.x * u + p.y * v + p.z * w;
    }
    return sites;
}

template <typename T>
std::vector<T> shuffled(std::vector<T> items, std::uint64_t seed) {
    Random random(seed);
    for (std::size_t i = items.size(); i > 1; --i) {
        std::swap(items[i - 1], items[random.below(i)]);
    }
    return items;
}

/// A flat fault x = at over the square [lo, hi]² in y and z.
inline Barrier fault_at_x(double at, double lo, double hi) {
    Barrier fault;
    fault.name = "flat";
    fault.sheet.vertices = {{at, lo, lo}, {at, hi, lo}, {at, hi, hi}, {at, lo, hi}};
    fault.sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    fault.spacing = (hi - lo) / 10;
    fault.width = fault.spacing / 4;
    fault.covering_radius = 0.7072 * fault.spacing;
    fault.protection_radius = std::hypot(fault.covering_radius, fault.width / 2);
    return fault;
}

}  // namespace terratet::testing
