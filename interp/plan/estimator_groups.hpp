// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model's properties, grouped by the estimators that serve them.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "interp/estimator/estimator.hpp"
#include "interp/estimator_plan.hpp"
#include "interp/natural/linear_precision.hpp"
#include "interp/natural/slopes.hpp"
#include "interp/plan/learned_errors.hpp"
#include "tess/barrier_query.hpp"
#include "tess/model.hpp"

namespace terratet {

/// A property's values at the sites of its group.
struct Column {
    std::size_t property;
    std::vector<double> measured;
    std::vector<double> scaled;
    ColumnTraits traits;
    std::optional<LearnedErrors> errors;
    EstimatorSpec open{};  ///< as asked or chosen, before it was fitted
};

/// Properties measured at the same samples, barred by the same and estimated alike, and the estimator over those.
struct Group {
    EstimatorSpec spec;
    const BarrierQuery* barriers = nullptr;
    std::vector<std::uint32_t> samples;
    std::vector<Vec3> sites;
    std::vector<Column> columns;
    std::unique_ptr<Estimator> estimator;
    std::shared_ptr<const Slopes> slopes;  ///< by column
};

/// One for each distinct set of samples and way of estimating; a property without samples is in no group and gets no
/// values. What the plan leaves open is chosen, fitted, and noted there.
std::vector<Group> groups_of(const Model& model, const BarrierQuery& barriers, EstimatorPlan& plan);

/// Leaves boreholes out to learn how far estimates are off; what is found comes back in the plan.
void learn_group(Group& group, const Model& model, const EstimatorPlan& asked, std::size_t max_folds,
                 EstimatorPlan& plan);

/// Where estimates differ between two groups of the same properties. Null: anywhere.
/// \param before_of  of each sample its number before; −1: none
std::unique_ptr<const ChangedPlaces> changes_between(const Group& before, const Group& after,
                                                     std::span<const std::int64_t> before_of);

}  // namespace terratet
