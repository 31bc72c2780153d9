// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/linear_precision.hpp"

#include <algorithm>
#include <cmath>

#include "interp/estimator_plan.hpp"
#include "interp/natural/slopes.hpp"

namespace terratet {

ColumnTraits traits_of(std::span<const double> scaled, double reach) {
    const auto [lowest, highest] = std::minmax_element(scaled.begin(), scaled.end());
    return {*lowest, *highest, reach};
}

MadeUp made_up(double plain, const Weights& weights, double extrapolation, const Slopes* slopes, std::size_t column,
               const ColumnTraits& traits) {
    const double part = std::min(2 * (1 - extrapolation), 1.0);
    if (slopes == nullptr || weights.lever == Vec3{} || part <= 0) {
        return {};
    }
    const auto along = slopes->along_lever(column, weights);
    // Gradients as of natural:smooth may have taken the mean itself out of the range: not for this to mend, or it would
    // jump where the lever ends.
    const double low = std::min(traits.lowest, plain), high = std::max(traits.highest, plain);
    return {std::clamp(plain + part * along.value, low, high) - plain, part * part * along.variance};
}

StatedError widened(const StatedError& stated, double slope_variance) {
    constexpr double normal_95 = 1.96;
    const auto plus = [](double a, double b) { return b > 0 ? std::hypot(a, b) : a; };
    const double own = std::sqrt(slope_variance);
    return {plus(stated.deviation, own), plus(stated.half_width, normal_95 * own)};
}

double weighted_mean(std::span<const SiteWeight> terms, std::span<const double> scaled) {
    double sum = 0;
    for (const auto& [site, weight] : terms) {
        sum += weight * scaled[site];
    }
    return sum;
}

}  // namespace terratet
