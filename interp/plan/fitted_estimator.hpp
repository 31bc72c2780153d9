// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What a specification leaves open, fitted to samples.

#include <cstddef>
#include <cstdint>
#include <span>

#include "interp/estimator_spec.hpp"
#include "tess/barrier_query.hpp"
#include "tess/property.hpp"

namespace terratet {

/// With what it leaves open fitted to values in the property's scale (variogram_fit.hpp, kriging_drift.hpp); as it is
/// when no parameter of the variogram is open.
/// \param faults  barriers; may be null
EstimatorSpec fitted_estimator(const EstimatorSpec& spec, std::span<const Vec3> sites, std::span<const double> values,
                               std::span<const std::int32_t> boreholes, Kind kind = Kind::continuous,
                               const BarrierQuery* barriers = nullptr, std::size_t most_samples = 5000);

}  // namespace terratet
