// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which estimator for which property, as a model keeps it.

#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "interp/calibration.hpp"
#include "interp/estimator_spec.hpp"

namespace terratet {

/// What is known of a property from all of its samples.
struct ColumnTraits {
    double lowest = 0;  ///< of the values, in the scale
    double highest = 0;
    double reach = 0;  ///< reach_of (extrapolation.hpp)
};

/// How an estimator was chosen by leaving boreholes out (plan/estimator_choice.hpp).
struct EstimatorChoice {
    double rms = 0;                ///< of its errors, in the scale
    double rms_plain = 0;          ///< of the isotropic one's; of `auto`, of natural neighbour's
    std::size_t better_folds = 0;  ///< of folds: where its errors are smaller
    std::size_t folds = 0;         ///< 0: too few samples or boreholes to choose
};

/// The estimators of a model's properties: one for all, but for those that have their own. Text: a specification, and
/// on further lines `SPEC of PROPERTY`, `samples:lowest=…:highest=…:reach=… of PROPERTY`,
/// `chosen:rms=…:plain=…:better=…:folds=… of PROPERTY`, and how far errors were found to go, as
/// `CALIBRATION of PROPERTY`.
struct EstimatorPlan {
    EstimatorSpec general;
    std::map<std::string, EstimatorSpec> of_property;
    std::map<std::string, ColumnTraits> traits{};       ///< of properties; missing: found from the samples
    std::map<std::string, EstimatorChoice> choices{};   ///< of properties whose estimator was chosen
    std::map<std::string, Calibration> calibrations{};  ///< of properties; missing: found when errors are asked for

    EstimatorPlan() = default;
    EstimatorPlan(EstimatorSpec spec) : general(std::move(spec)) {}  // NOLINT: one for all is the usual plan

    /// Its own, or the general one.
    [[nodiscard]] const EstimatorSpec& of(const std::string& property) const;
    /// What the model keeps, a line a property and fact; parse_estimator_plan() brings it back.
    [[nodiscard]] std::string to_string() const;
};

/// Of an empty text the default: natural neighbour for all. Throws UsageError as parse_estimator does, also for
/// traits, a choice or a calibration that no samples can have.
EstimatorPlan parse_estimator_plan(const std::string& text);

}  // namespace terratet
