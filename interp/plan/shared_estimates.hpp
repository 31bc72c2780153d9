// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Estimates by several ranks: places are dealt out in runs along Morton order, so that each rank asks near ones one
/// after the other.

#include <span>
#include <vector>

#include "interp/model_estimator.hpp"
#include "interp/ranks/ranks.hpp"

namespace terratet {

/// At rank 0: as estimator.estimates(queries), to the bit. The others are serving the same estimator.
std::vector<PropertyEstimates> shared_estimates(const ModelEstimator& estimator, std::span<const ValueQuery> queries,
                                                const Ranks& ranks);

/// At the others: answers until rank 0 ends it.
void serve_estimates(const ModelEstimator& estimator, const Ranks& ranks);
void end_serving(const Ranks& ranks);

}  // namespace terratet
