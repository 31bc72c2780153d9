// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How values reach the tessellation: a batched callable that the caller provides (an estimator over the original
/// samples, a formula, a test's lambda). tess knows nothing of estimation methods.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// Where values are wanted. A place on a fault is asked for on one of its sides.
struct ValueQuery {
    Vec3 position;              ///< frame-local
    std::int32_t barrier = -1;  ///< the fault whose seed this is, or -1
    std::int8_t side = 0;       ///< +1 or −1 for a seed: its side of that fault; 0 otherwise
};

/// Values at places: values[property][query] in measured units, NaN where there is none; extrapolation[query] in 0…1.
struct ValueBatch {
    std::vector<std::vector<double>> values;
    std::vector<double> extrapolation;
};

/// Must be a pure function of each query (no dependence on the batch or on its order), safe to call from one thread at
/// a time; it may work in parallel inside.
using ValueSource = std::function<ValueBatch(std::span<const ValueQuery>)>;

}  // namespace terratet
