// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How far off a model's estimates are, learnt by leaving boreholes out.

#include <optional>
#include <span>
#include <vector>

#include "interp/calibration.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/estimator_plan.hpp"
#include "interp/natural/linear_precision.hpp"
#include "interp/plan/local_error.hpp"
#include "tess/barrier_query.hpp"
#include "tess/property.hpp"
#include "tess/samples.hpp"

namespace terratet {

/// Of one property.
struct LearnedErrors {
    std::optional<LocalError> local;  ///< none: the method has a variance of its own
    Calibration calibration;

    /// Of an estimate, in the property's scale; NaN: unknown.
    [[nodiscard]] StatedError of(const Vec3& place, const Weights& weights, double estimate) const;
};

/// Properties measured at the same samples and estimated alike.
struct ErrorTask {
    struct Column {
        std::span<const double> scaled;  ///< at the sites
        bool continuous;                 ///< of a category nothing is learnt
        const Calibration* known;        ///< found earlier, to be kept; null: to be found
        ColumnTraits traits;
    };

    EstimatorSpec spec;  ///< as fitted to all sites
    EstimatorSpec open;  ///< what it was fitted from, so that it is fitted anew without the boreholes left out: to the
                         ///< first column
    const Samples& samples;
    std::span<const std::uint32_t> which;  ///< the sites as samples
    std::span<const Vec3> sites;
    std::span<const std::int32_t> boreholes;
    const BarrierQuery& barriers;
    std::vector<Column> columns;
    std::size_t max_folds = 20;
};

/// Entries are those of task.columns, none of a category. Costs an estimator and a fit a fold, unless all that is
/// wanted is known; of 100 boreholes or more 8 folds do, and some 5000 samples are judged at most. `task` is not needed
/// afterwards, its sites are.
std::vector<std::optional<LearnedErrors>> learn_errors(const ErrorTask& task);

/// A kriging specification as it was before it was fitted: whatever of the variogram `asked` left open, the drift as
/// chosen. \param asked  that `fitted` came of; where it is complete, as a stored model's is, what a fit to all samples
/// finds again was fitted
EstimatorSpec open_again(const EstimatorSpec& fitted, const EstimatorSpec& asked, std::span<const Vec3> sites,
                         std::span<const double> values, std::span<const std::int32_t> boreholes, Kind kind);

}  // namespace terratet
