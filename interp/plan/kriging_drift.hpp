// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Is there a trend? Ordinary kriging knows an unknown mean only; along a trend it is biased beyond the outermost
/// samples and its variogram, which never ends rising, states errors several times too large.

#include <cstdint>
#include <span>
#include <string>

#include "interp/estimator_spec.hpp"
#include "tess/barrier_query.hpp"

namespace terratet {

/// "linear" where a plane explains at least a tenth of the values' variance and, boreholes being left out in ten
/// groups, universal kriging's errors are smaller than ordinary kriging's by more than 3 %, in the mean square and in
/// the mean; else "constant", as with fewer than five boreholes. Looks at 4000 samples at most: about a second.
/// \param open  a kriging specification without a drift
std::string better_drift(const EstimatorSpec& open, std::span<const Vec3> sites, std::span<const double> values,
                         std::span<const std::int32_t> boreholes, const BarrierQuery* barriers);

}  // namespace terratet
