// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One property's estimates in its scale: weighted means, and what slopes add to them where weights are hidden
/// (slopes.hpp). The addition is whole up to an extrapolation of 0.5 and fades from there to 0 at 1; it never takes an
/// estimate out of the range of the property's values.

#include <memory>
#include <span>
#include <vector>

#include "interp/estimator/estimator.hpp"
#include "interp/estimator_plan.hpp"

namespace terratet {

/// What is needed besides weights. From all of a property's samples, also where some are left out.
ColumnTraits traits_of(std::span<const double> scaled, double reach);

/// Added to a weighted mean.
struct MadeUp {
    double value = 0;
    double variance = 0;  ///< of the slopes
};

/// \param plain  Σ wz
/// \param slopes of the sites that the weights name; null: nothing is made up
MadeUp made_up(double plain, const Weights& weights, double extrapolation, const Slopes* slopes, std::size_t column,
               const ColumnTraits& traits);

/// Of an estimate, with what the slopes' variance adds.
StatedError widened(const StatedError& stated, double slope_variance);

/// Σ wz.
double weighted_mean(std::span<const SiteWeight> terms, std::span<const double> scaled);

}  // namespace terratet
