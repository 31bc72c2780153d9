// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How far an estimate reaches beyond the samples, a figure to mask by: e = min(1, d / 2a), d the shortest way round
/// barriers to a sample (ways_round.hpp) and a the distance over which samples tell something, both in the coordinates
/// of the estimator's anisotropy. 0 on a sample, 0.5 at a, 1 from 2a on.

#include <cstdint>
#include <span>

#include "interp/estimator_spec.hpp"

namespace terratet {

/// a: kriging's range (Variogram::practical_range), else three times the spacing of the samples: the median over up to
/// a thousand of them of the distance to another borehole's nearest; for a loose sample to the nearest of the third of
/// the eight octants around it, for loose samples may well stand in lines, and a line takes no more than two. Where
/// there is no other borehole, half the diagonal of the samples' box. 0 for a single sample. Some 20 ms.
/// \param spec  lacks nothing (needs_values)
double reach_of(const EstimatorSpec& spec, std::span<const Vec3> sites, std::span<const std::int32_t> boreholes);

/// e.
double extrapolation_at(double distance, double reach);

}  // namespace terratet
