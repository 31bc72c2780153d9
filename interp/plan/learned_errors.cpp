// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/learned_errors.hpp"

#include <algorithm>
#include <cmath>

#include "interp/estimator_spec.hpp"
#include "interp/kriging/variogram_fit.hpp"
#include "interp/plan/error_study.hpp"
#include "interp/plan/fitted_estimator.hpp"
#include "interp/plan/folds.hpp"
#include "interp/plan/make_estimator.hpp"

namespace terratet {
namespace {

constexpr std::size_t judged_max = 5000;
constexpr std::size_t boreholes_many = 100;  // of which fewer groups do, still of twelve boreholes or more:
constexpr std::size_t folds_of_many = 8;     // each costs a tessellation

template <typename T>
std::vector<T> picked(std::span<const T> from, std::span<const std::uint32_t> which) {
    std::vector<T> out;
    out.reserve(which.size());
    for (const std::uint32_t i : which) {
        out.push_back(from[i]);
    }
    return out;
}

/// Estimates each site from the others' folds and tells the studies; the weights of those to be judged come back.
std::vector<Weights> leave_out(const ErrorTask& task, const std::vector<std::vector<std::uint32_t>>& folds,
                               std::vector<std::optional<ErrorStudy>>& studies) {
    const PartialEstimator make = [&](std::span<const std::uint32_t> kept, std::uint32_t) {
        auto sites = picked(task.sites, kept);
        auto boreholes = picked(task.boreholes, kept);
        const EstimatorSpec spec =
            needs_values(task.open) ? fitted_estimator(task.open, sites, picked(task.columns.front().scaled, kept),
                                                       boreholes, Kind::continuous, &task.barriers, samples_of_fold_fit)
                                    : task.spec;
        return make_estimator(spec, std::move(sites), &task.barriers, std::move(boreholes));
    };
    std::vector<Weights> weights(task.sites.size());
    std::vector<FoldColumn> columns;
    for (const auto& column : task.columns) {
        columns.push_back({column.scaled, column.traits});
    }
    for_each_left_out(
        task.sites, folds, make, columns,
        [&](std::uint32_t site, const auto& left_out, auto added) {
            for (std::size_t c = 0; c < studies.size(); ++c) {
                if (studies[c]) {
                    const double plain = weighted_mean(left_out.terms, task.columns[c].scaled);
                    studies[c]->add(site, plain + added[c].value, left_out);
                }
            }
            weights[site] = left_out;
        },
        SomeSites(task.sites.size(), judged_max));
    return weights;
}

}  // namespace

StatedError LearnedErrors::of(const Vec3& place, const Weights& weights, double estimate) const {
    const double own = local ? local->standard_deviation(place, weights) : std::sqrt(weights.variance);
    return calibration.stated(estimate, own);
}

std::vector<std::optional<LearnedErrors>> learn_errors(const ErrorTask& task) {
    const std::size_t boreholes = folds_of(task.samples, task.which).size();
    const std::size_t most = boreholes < boreholes_many ? task.max_folds : std::min(task.max_folds, folds_of_many);
    const auto folds = folds_of(task.samples, task.which, most);
    const bool own_variance =
        make_estimator(task.spec, {task.sites.front()}, &task.barriers, {task.boreholes.front()})->has_variance();
    std::vector<std::optional<LearnedErrors>> out(task.columns.size());
    bool all_known = true;
    for (std::size_t c = 0; c < out.size(); ++c) {
        const auto& column = task.columns[c];
        if (column.continuous) {
            out[c].emplace(LearnedErrors{{}, column.known != nullptr ? *column.known : Calibration{}});
            all_known = all_known && column.known != nullptr;
        }
    }
    const bool nothing_to_learn =
        std::none_of(task.columns.begin(), task.columns.end(), [](const auto& column) { return column.continuous; });
    if (nothing_to_learn || (all_known && own_variance)) {
        return out;
    }
    const ErrorGroups groups(task.sites.size(), folds, folds.size(), boreholes);
    std::vector<std::optional<ErrorStudy>> studies(out.size());
    for (std::size_t c = 0; c < out.size(); ++c) {
        if (out[c]) {
            studies[c].emplace(task.sites, task.columns[c].scaled, groups, own_variance);
        }
    }
    const auto weights = leave_out(task, folds, studies);
    for (std::size_t c = 0; c < out.size(); ++c) {
        if (!out[c]) {
            continue;
        }
        if (task.columns[c].known != nullptr) {
            studies[c]->learn(&task.barriers);
        } else {
            studies[c]->judge(&task.barriers, weights);
            out[c]->calibration = studies[c]->calibration();
        }
        out[c]->local = studies[c]->take_local();
    }
    return out;
}

EstimatorSpec open_again(const EstimatorSpec& fitted, const EstimatorSpec& asked, std::span<const Vec3> sites,
                         std::span<const double> values, std::span<const std::int32_t> boreholes, Kind kind) {
    if (fitted.name != "kriging") {
        return fitted;
    }
    const bool known = needs_values(asked);
    EstimatorSpec open = fitted;
    for (const char* key : {"nugget", "sill", "range", "ratio3"}) {
        if (!known || !asked.options.contains(key)) {
            open.options.erase(key);
        }
    }
    return known || fitted_estimator(open, sites, values, boreholes, kind).to_string() == fitted.to_string() ? open
                                                                                                             : fitted;
}

}  // namespace terratet
