// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What `terratet validate` finds out, as a table, as JSON and as charts.

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "interp/estimator_spec.hpp"
#include "interp/kriging/variogram_fit.hpp"
#include "interp/plan/cross_validation.hpp"
#include "interp/plan/estimator_choice.hpp"
#include "io/write/write_svg.hpp"
#include "tess/progress.hpp"

namespace terratet::tools {

/// One property: its variogram and how each estimator did.
struct PropertyValidation {
    std::size_t property = 0;
    VariogramFit variogram;
    std::string drift{};  ///< that it is fitted about: linear, constant; empty: no kriging was asked for
    std::vector<CrossValidation> estimators;  ///< in the order they were asked for
    ChosenEstimator suggestion{};             ///< empty trials: none was asked for, or too few samples to tell
};

/// Of all properties with samples. What specifications leave to be chosen is chosen once, from all samples, as for a
/// model. \pre specs are valid
std::vector<PropertyValidation> validate_all(const Model& model, const BarrierQuery& faults,
                                             const std::vector<EstimatorSpec>& specs,
                                             const CrossValidationOptions& options, bool suggest,
                                             const Progress& progress);

std::string validation_text(const Model& model, const std::vector<PropertyValidation>& all);
nlohmann::ordered_json validation_json(const Model& model, const std::vector<PropertyValidation>& all);

/// For each continuous property its variogram, then for each estimator estimated over measured.
std::vector<Chart> validation_charts(const Model& model, const std::vector<PropertyValidation>& all);

}  // namespace terratet::tools
