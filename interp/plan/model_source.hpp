// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The bridge between estimators and the tessellation: a ValueSource over a model's samples.

#include "interp/estimator_plan.hpp"
#include "interp/model_estimator.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

namespace terratet {

/// ModelEstimator::values() as a value source. Both `model` and `faults` must outlive it.
ValueSource make_model_source(const Model& model, const BarrierQuery& barriers, const EstimatorPlan& plan,
                              std::shared_ptr<EstimatorCounters> counters = {});

}  // namespace terratet
