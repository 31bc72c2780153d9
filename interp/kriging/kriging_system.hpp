// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One kriging system: covariances of a neighbourhood, its factor, the weights at a place (Cressie 1993, 3.2 and 3.4;
/// Chilès and Delfiner 2012, 3.3 and 3.4). Everything in correlations, with nugget + sill = 1, since weights don't
/// depend on the scale and pivots then have one. The one translation unit with Eigen.

#include <memory>
#include <span>
#include <vector>

#include "interp/estimator/variogram.hpp"

namespace terratet {

enum class Drift { constant, linear };

class KrigingSystem {
  public:
    explicit KrigingSystem(const Variogram& variogram, Drift drift);
    ~KrigingSystem();

    /// Sets and factors the correlations between n ≥ 1 places in the variogram's metric. Singular or nearly so
    /// (gaussian models without nugget are): solved with a nugget of 1e-8 instead, and said. O(n³).
    void set_places(std::span<const Vec3> places);

    struct Result {
        double variance = 0;    ///< over nugget + sill; not below 0
        double mean_share = 0;  ///< weight of the unknown mean in simple kriging, 0…1: what the places do not say
        bool fallback = false;  ///< a nugget was put in, or the drift left out where the places don't determine it
    };

    /// Weights at `query`, which is none of the places, into `weights`; they sum to 1. False where no way gives finite
    /// ones. \param offsets  places minus query, in true directions, for the drift. O(n²).
    bool solve(const Vec3& query, std::span<const Vec3> offsets, std::vector<double>& weights, Result& result);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Values less their least-squares plane a + b·x + c·y + d·z (minimum norm where places don't determine it).
std::vector<double> without_linear_trend(std::span<const Vec3> places, std::span<const double> values);

}  // namespace terratet
