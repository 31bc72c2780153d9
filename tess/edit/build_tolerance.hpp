// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A build to a tolerance: which one where none is given, and the local l_min that the samples ask for.

#include "tess/build_options.hpp"

namespace terratet {

/// Is the tolerance left to be chosen? Where neither l_min nor a tolerance nor a df_max is given.
bool chooses_tolerance(const BuildOptions& options);

/// Fills in what goes with a tolerance: l_min between samples and its floor; tolerances to be chosen are marked by what
/// they may be at most. \pre l_min is known.
void set_tolerance_defaults(const BuildOptions& options, double diagonal, Model& model);

/// Settles tolerances to be chosen, and finds the fine places unless the model has them (an edit keeps them).
/// \param inside  the samples in the extent, in canonical order.
void retain_samples(const BuildOptions& options, std::span<const std::uint32_t> inside, const BarrierQuery& barriers,
                    Model& model, const Poll& poll);

/// How far the field may be from the estimator, once that is known.
void set_residual_limits(const BuildOptions& options, Model& model);

/// RefineOptions::enough_vertices: 0 where l_min between samples is given.
std::uint64_t enough_vertices(const BuildOptions& options, const Model& model);

/// Keeps what l_min between samples came to, with a note where it went no further.
void keep_l_min_between(Model& model, BuildReport& report);

/// As a built model knows it, for BuildOptions. \pre The model outlives it.
std::function<double(const Property&)> stored_noise(const Model& model);

/// Says what l_min left out, where it loses the field.
void note_lost_field(const Model& model, BuildReport& report);

}  // namespace terratet
