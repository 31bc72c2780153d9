// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What is known about a model's values, as further properties of its vertices, so that every output carries it.

#include "interp/model_estimator.hpp"
#include "tess/model.hpp"

namespace terratet {

/// Appends to the model, for each property with samples, properties that no sample has, estimated at the vertices:
///   NAME_sd             standard deviation, in the property's unit, or in decades for the log10 scale
///   NAME_ci95           half-width of the interval about the value that holds 95 %, in the same
///   NAME_extrapolation  0…1
///   NAME_samples        how many samples have a weight
/// and for a category instead of the first NAME_entropy (bits) and a NAME_p_CLASS for each class. A name that a
/// measured property has gets "_estimate" behind it. Those that are there from an earlier call are replaced.
/// \param estimator  of this model, with uncertainty prepared; not used afterwards: the model it reads has changed
void add_uncertainty(Model& model, const ModelEstimator& estimator);

/// All properties of the model at other places than its vertices, those that add_uncertainty() added included.
/// \param estimator  of this model; with uncertainty prepared if there are such properties
ValueBatch estimated_properties(const Model& model, const ModelEstimator& estimator,
                                std::span<const ValueQuery> places);

/// Has add_uncertainty() added any?
bool has_derived_properties(const Model& model);

}  // namespace terratet
