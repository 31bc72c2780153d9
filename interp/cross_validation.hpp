// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cross-validation: each borehole is left out and estimated from the others, and what comes out is compared with what
/// was measured. All numbers are in the property's scale (decades for log10).

#include <cstdint>
#include <string>
#include <vector>

#include "interp/model_estimator.hpp"

namespace terratet {

struct CrossValidationOptions {
    std::size_t max_folds = 0;     ///< boreholes share so many folds; 0: each is left out alone
    std::size_t loose_folds = 20;  ///< blocks of loose samples
};

/// One estimator and one property, over the samples that have the property.
struct CrossValidation {
    EstimatorSpec asked;
    EstimatorSpec estimator;  ///< as fitted: once, to all samples, as a model's is
    std::size_t property = 0;
    std::vector<std::uint32_t> sample;  ///< indices into the model's samples
    std::vector<double> measured;       ///< in the property's scale; of a category the class
    std::vector<double> estimated;      ///< NaN: the others give no value
    std::vector<double> deviation;      ///< stated; NaN: none
    DeviationSource deviation_source = DeviationSource::none;
    std::size_t folds = 0;
    std::size_t fallbacks = 0;
};

struct CrossValidationScore {
    std::size_t count = 0;          ///< samples with an estimate
    std::size_t without_value = 0;  ///< samples without
    double rmse = missing;
    double mae = missing;
    double bias = missing;              ///< mean of estimated − measured
    double rank_correlation = missing;  ///< Spearman's, ties shared; NaN when either side is constant
    double within_one = missing;        ///< share of errors within one stated standard deviation; 0.683 if normal
    double within_two = missing;        ///< within 1.96; 0.95 if normal
    double accuracy = missing;          ///< categories only: share of right classes; the others are NaN then
};

/// A cross-validated deviation knows the errors at all samples, so those near the borehole that is left out have seen
/// it: its coverage is a little flattered; kriging's is not. Folds run in parallel; the result does not depend on it.
/// Costs an estimator for each fold, and the weights of all samples are held at once (16 bytes a term).
/// \pre the property has a sample
CrossValidation cross_validate(const Model& model, const FaultProximity& faults, std::size_t property,
                               const EstimatorSpec& spec, const CrossValidationOptions& options = {});

CrossValidationScore score(const CrossValidation& validation, const Property& property);

}  // namespace terratet
