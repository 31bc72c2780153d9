// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A specification's variogram, as far as it leaves it open, fitted to samples.

#include <cstddef>
#include <cstdint>
#include <span>

#include "interp/estimator_spec.hpp"
#include "interp/kriging/variogram_fit.hpp"
#include "tess/property.hpp"

namespace terratet {

/// What a kriging specification leaves open, about a plane where its drift is linear; any other method's: a spherical
/// model. Values of kind categorical are classes.
VariogramFit fit_variogram(const EstimatorSpec& spec, std::span<const Vec3> places, std::span<const double> values,
                           std::span<const std::int32_t> boreholes, Kind kind, std::size_t most_samples = 5000);

/// The specification with it. As it is when no parameter of the variogram is open.
EstimatorSpec with_fitted_variogram(const EstimatorSpec& spec, std::span<const Vec3> places,
                                    std::span<const double> values, std::span<const std::int32_t> boreholes, Kind kind,
                                    std::size_t most_samples = 5000);

}  // namespace terratet
