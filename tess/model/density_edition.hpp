// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Density edition itself (density.hpp: the choices and the guarantees).

#include <span>

#include "tess/barrier_query.hpp"
#include "tess/density.hpp"
#include "tess/model.hpp"
#include "tess/model/resolution.hpp"
#include "tess/progress.hpp"
#include "tess/samples.hpp"

namespace terratet {

/// The samples that lie in no protection zone, as indices.
std::vector<std::uint32_t> unprotected(const Samples& samples, const BarrierQuery& barriers, const Poll& poll = {});

/// Of these, in the order given, those that have no kept one within their place's l_min.
std::vector<std::uint32_t> keep_in_order(const Samples& samples, std::span<const std::uint32_t> candidates,
                                         const ResolutionField& resolution, const Poll& poll = {});

/// D1 with different l_min at two samples: the smaller one. D2: that of the dropped sample.
/// \pre samples are merged (no coincident positions) and in canonical order. O(n) for canonical, O(n log n) for paper.
DensityResult edit_density(const Samples& samples, const ResolutionField& resolution, DensityMode mode,
                           const BarrierQuery& barriers, const Poll& poll = {});

/// The same with one l_min everywhere.
DensityResult edit_density(const Samples& samples, double l_min, DensityMode mode, const BarrierQuery& barriers);

/// Those of the model's samples in the extent, outside protection zones, that are no vertices.
Samples dropped_samples(const Model& model, const BarrierQuery& barriers);

}  // namespace terratet
