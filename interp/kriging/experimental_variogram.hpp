// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Experimental variograms: half the mean squared difference of pairs of samples, by distance.

#include <cstdint>
#include <span>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// Pairs at distances in (k·width, (k+1)·width].
struct Lag {
    double distance = 0;      ///< mean of the pairs'
    double semivariance = 0;  ///< in the values' unit squared
    std::uint64_t pairs = 0;
};

/// Which pairs count.
enum class PairKind : std::uint8_t {
    all,
    same_borehole,   ///< along holes
    other_borehole,  ///< across; loose samples are boreholes of their own
};

struct VariogramOptions {
    double width = 0;  ///< of a lag, above 0
    std::size_t lags = 15;
    PairKind pairs = PairKind::all;
    Vec3 direction{0, 0, 0};          ///< unit vector, to or fro; zero: any
    double tolerance_deg = 22.5;      ///< a pair's largest angle to it
    bool horizontal = false;          ///< only pairs within tolerance_deg of the horizontal
    bool robust = false;              ///< Cressie and Hawkins (1980): by square roots, less moved by outliers
    bool categorical = false;         ///< values are classes: half the sum of all indicators' squared differences
    std::size_t most_samples = 5000;  ///< beyond, pairs of every second, third … sample; along holes, of one hole
};

/// Lags without pairs are left out. With n samples n²/2 pairs, at most 1.25e7, and 10 ns a pair; sums are taken in the
/// samples' order, so results do not depend on threads.
/// \param boreholes  of each sample, −1 for a loose one; in canonical order; empty: all loose
std::vector<Lag> experimental_variogram(std::span<const Vec3> places, std::span<const double> values,
                                        std::span<const std::int32_t> boreholes, const VariogramOptions& options);

}  // namespace terratet
