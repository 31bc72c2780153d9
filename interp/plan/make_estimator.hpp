// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// From a specification to an estimator.

#include <cstdint>
#include <memory>
#include <vector>

#include "interp/estimator/estimator.hpp"
#include "interp/estimator_spec.hpp"
#include "tess/barrier_query.hpp"

namespace terratet {

/// \pre `spec` lacks nothing (needs_values)
/// \param sites     distinct positions, at least one
/// \param faults    barriers; must outlive the estimator; may be null
/// \param boreholes of each site its borehole, −1 for a loose one, for methods that limit how many of one borehole they
///                  take; empty: all loose
std::unique_ptr<Estimator> make_estimator(const EstimatorSpec& spec, std::vector<Vec3> sites,
                                          const BarrierQuery* barriers, std::vector<std::int32_t> boreholes = {});

}  // namespace terratet
