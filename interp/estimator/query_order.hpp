// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How every estimator goes through a batch: near queries one after the other, runs of them in parallel.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "interp/estimator/estimator.hpp"
#include "tess/value_source.hpp"

namespace terratet {

/// Indices into `queries` in Morton order, as fine as 64 bits hold beside the index.
std::vector<std::uint32_t> spatial_order(std::span<const ValueQuery> queries);

/// Calls `work` with indices into `queries`, each index in exactly one call; calls run at the same time on TBB's
/// threads. A batch of fewer than 64 is one call on this thread: the refiner asks for one place at a time.
void in_spatial_order(std::span<const ValueQuery> queries,
                      const std::function<void(std::span<const std::uint32_t>)>& work);

/// The same for work that reads queries[i] and writes out[i]: their memory, scattered in this order, is asked for a run
/// ahead (a tenth of the time of the simple estimators).
void in_spatial_order(std::span<const ValueQuery> queries, std::span<Weights> out,
                      const std::function<void(std::span<const std::uint32_t>)>& work);

}  // namespace terratet
