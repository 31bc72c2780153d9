// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Density edition itself (density.hpp: the choices and the guarantees).

#include "tess/barrier_query.hpp"
#include "tess/density.hpp"
#include "tess/model/resolution.hpp"
#include "tess/progress.hpp"
#include "tess/samples.hpp"

namespace terratet {

/// D1 with different l_min at two samples: the smaller one. D2: that of the dropped sample.
/// \pre samples are merged (no coincident positions) and in canonical order. O(n) for canonical, O(n log n) for paper.
DensityResult edit_density(const Samples& samples, const ResolutionField& resolution, DensityMode mode,
                           const BarrierQuery& barriers, const Poll& poll = {});

/// The same with one l_min everywhere.
DensityResult edit_density(const Samples& samples, double l_min, DensityMode mode, const BarrierQuery& barriers);

}  // namespace terratet
