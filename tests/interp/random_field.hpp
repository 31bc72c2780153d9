// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Fields whose covariance is known.

#include <array>
#include <cmath>
#include <numbers>

#include "support.hpp"

namespace terratet::testing {

/// A random field of mean 0 and variance 1 with the given covariance, by many cosine waves (spectral method):
/// exponential across, with ranges shorter along z.
class RandomField {
  public:
    RandomField(double range, double vertical, std::uint64_t seed) {
        Random random(seed);
        const auto gauss = [&] {
            return std::sqrt(-2 * std::log(1 - random())) * std::cos(2 * std::numbers::pi * random());
        };
        for (auto& wave : waves_) {
            // The spectrum of exp(-h/a) in three dimensions is a Cauchy density: normal over the root of a chi square.
            const double scale = 1 / std::abs(gauss());
            wave.k = Vec3{gauss() / range, gauss() / range, gauss() / vertical} * scale;
            wave.phase = 2 * std::numbers::pi * random();
        }
    }
    double operator()(const Vec3& p) const {
        double sum = 0;
        for (const auto& wave : waves_) {
            sum += std::cos(dot(wave.k, p) + wave.phase);
        }
        return sum * std::sqrt(2.0 / double(waves_.size()));
    }

  private:
    struct Wave {
        Vec3 k;
        double phase;
    };
    std::array<Wave, 1000> waves_;
};

}  // namespace terratet::testing
