// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What a specification says of kriging.

#include <optional>

#include "interp/estimator_spec.hpp"
#include "interp/kriging/kriging.hpp"

namespace terratet {

Neighbourhood neighbourhood_of(const EstimatorSpec& spec);
VariogramFamily family_of(const EstimatorSpec& spec);
Drift drift_of(const EstimatorSpec& spec);

/// \pre `spec` lacks nothing (needs_values)
KrigingOptions kriging_options(const EstimatorSpec& spec);

/// The distance over which its variogram's samples tell something (Variogram::practical_range); none without one.
/// \pre `spec` lacks nothing
std::optional<double> range_of(const EstimatorSpec& spec);

}  // namespace terratet
