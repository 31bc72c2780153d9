// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/kriging_drift.hpp"

#include <cmath>
#include <numeric>

#include "interp/kriging/fitted_variogram.hpp"
#include "interp/kriging/kriging_system.hpp"
#include "interp/kriging/variogram_fit.hpp"
#include "interp/plan/folds.hpp"
#include "interp/plan/make_estimator.hpp"

namespace terratet {
namespace {

constexpr std::size_t samples_max = 4000;
constexpr std::size_t groups_max = 10;
constexpr std::size_t boreholes_min = 5;
constexpr double trend_min = 0.1;
constexpr double gain_min = 0.03;

double mean_square(std::span<const double> values) {
    double sum = 0;
    for (const double value : values) {
        sum += value * value;
    }
    return sum / static_cast<double>(values.size());
}

double variance(std::span<const double> values) {
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    std::vector<double> rest(values.begin(), values.end());
    for (double& value : rest) {
        value -= mean;
    }
    return mean_square(rest);
}

}  // namespace

std::string better_drift(const EstimatorSpec& open, std::span<const Vec3> all_sites, std::span<const double> all_values,
                         std::span<const std::int32_t> all_boreholes, const BarrierQuery* barriers) {
    std::vector<Vec3> sites;
    std::vector<double> values;
    std::vector<std::int32_t> boreholes;
    const std::size_t step = (all_sites.size() + samples_max - 1) / samples_max;
    for (std::size_t i = 0; i < all_sites.size(); i += step) {
        sites.push_back(all_sites[i]);
        values.push_back(all_values[i]);
        boreholes.push_back(all_boreholes.empty() ? -1 : all_boreholes[i]);
    }
    const double spread = variance(values);
    if (!(spread > 0) || variance(without_linear_trend(sites, values)) > (1 - trend_min) * spread) {
        return "constant";
    }
    const auto folds = folds_of(sites, boreholes);
    if (folds.size() < boreholes_min) {
        return "constant";
    }
    const auto groups = shared(folds, groups_max);
    double square[2] = {0, 0};
    double magnitude[2] = {0, 0};
    for (const std::size_t linear : {0, 1}) {
        EstimatorSpec spec = open;
        spec.options["drift"] = linear == 1 ? "linear" : "constant";
        const auto make = [&](std::span<const std::uint32_t> kept, std::uint32_t) {
            std::vector<Vec3> some;
            std::vector<double> known;
            std::vector<std::int32_t> holes;
            for (const std::uint32_t i : kept) {
                some.push_back(sites[i]);
                known.push_back(values[i]);
                holes.push_back(boreholes[i]);
            }
            const auto fitted = with_fitted_variogram(spec, some, known, holes, Kind::continuous, samples_of_fold_fit);
            return make_estimator(fitted, std::move(some), barriers, std::move(holes));
        };
        for_each_left_out(sites, groups, make, {}, [&](std::uint32_t site, const Weights& weights, const auto&) {
            if (!weights.terms.empty()) {
                const double error = weighted_mean(weights.terms, values) - values[site];
                square[linear] += error * error;
                magnitude[linear] += std::abs(error);
            }
        });
    }
    const double least = 1 - gain_min;
    const bool better = std::sqrt(square[1]) < least * std::sqrt(square[0]) && magnitude[1] < least * magnitude[0];
    return better ? "linear" : "constant";
}

}  // namespace terratet
