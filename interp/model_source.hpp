// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The bridge between estimators and the tessellation: a ValueSource over a model's samples.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "interp/estimator.hpp"
#include "tess/model.hpp"

namespace terratet {

struct EstimatorCounters {
    std::atomic<std::uint64_t> queries{0};
    std::atomic<std::uint64_t> fallbacks{0};
};

/// Values of all properties of `model` from its samples (all of them, dropped ones included), in each property's scale.
/// Properties measured at the same samples share one estimator. A categorical property gets the class of the largest
/// summed weight (ties: the smaller index). A query exactly on a sample returns its value. The extrapolation is the
/// largest among the properties that have a value there, 1 where none has. Works in parallel (TBB); results do not depend
/// on it. Samples are at distinct positions (merge_coincident). Both `model` and `faults` must outlive the source.
ValueSource make_model_source(const Model& model, const FaultProximity& faults, const EstimatorSpec& spec,
                              std::shared_ptr<EstimatorCounters> counters = {});

}  // namespace terratet
