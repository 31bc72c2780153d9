// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cross-validation: each borehole is left out and estimated from the others, and what comes out is compared with what
/// was measured. All numbers are in the property's scale (decades for log10).

#include <cstdint>
#include <string>
#include <vector>

#include "interp/estimator_spec.hpp"
#include "interp/model_estimator.hpp"
#include "tess/barrier_query.hpp"
#include "tess/property.hpp"

namespace terratet {

class Ranks;

struct CrossValidationOptions {
    std::size_t max_folds = 0;     ///< boreholes share so many folds; 0: each is left out alone
    std::size_t loose_folds = 20;  ///< blocks of loose samples
    const Ranks* ranks = nullptr;  ///< who share the folds, each calling with the same data; all get the same result
};

/// One estimator and one property, over the samples that have the property.
struct CrossValidation {
    EstimatorSpec asked;
    EstimatorSpec estimator;  ///< as fitted to all samples, as a model's is
    std::size_t property = 0;
    std::vector<std::uint32_t> sample;  ///< indices into the model's samples
    std::vector<double> measured;       ///< in the property's scale; of a category the class
    std::vector<double> estimated;      ///< NaN: the others give no value
    std::vector<double> deviation;      ///< stated by those that have not seen the error; NaN: none
    std::vector<double> half_width;     ///< likewise, of the interval that should hold 95 %
    Calibration calibration;            ///< as found from all errors, as a model's is
    DeviationSource deviation_source = DeviationSource::none;
    std::size_t folds = 0;
    std::size_t fallbacks = 0;
};

struct CrossValidationScore {
    std::size_t count = 0;          ///< samples with an estimate
    std::size_t without_value = 0;  ///< samples without
    double rmse = missing;
    double mae = missing;
    double bias = missing;               ///< mean of estimated − measured
    double rank_correlation = missing;   ///< Spearman's, ties shared; NaN when either side is constant
    double within_one = missing;         ///< share of errors within one stated standard deviation; 0.683 if normal
    double within_two = missing;         ///< within 1.96; 0.95 if normal
    double within_half_width = missing;  ///< should be 0.95
    double accuracy = missing;           ///< categories only: share of right classes; the others are NaN then
};

/// Boreholes are judged in 20 groups: what is stated of a group's errors, a fitted variogram included, comes from the
/// other groups' samples and errors alone. (Whether to take a drift is decided once, from all.) Folds run in parallel;
/// the result does not depend on it. Costs an estimator for each fold, up to 20 fits, and the weights of all samples
/// are held at once (16 bytes a term) where the method has no variance of its own.
/// \pre the property has a sample
CrossValidation cross_validate(const Model& model, const BarrierQuery& barriers, std::size_t property,
                               const EstimatorSpec& spec, const CrossValidationOptions& options = {});

CrossValidationScore score(const CrossValidation& validation, const Property& property);

}  // namespace terratet
