// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// From a site's surfaces to the model's barriers, and to the hull box that holds them.

#include "tess/build_options.hpp"
#include "tess/model.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// Prepares all surfaces of the model within its extent: barrier_options, barriers and, where there are any, the hull
/// box. What became of each goes to report.barriers. Throws InputError when the ground or a domain's wall cannot be
/// followed, UsageError for options that contradict each other. \pre The extent is resolved.
void prepare_boundary(const BuildOptions& options, Model& model, BuildReport& report, const Progress& progress);

/// Throws UsageError when a name belongs to no region, or a region to two names.
void name_regions(const BuildOptions& options, Model& model);

}  // namespace terratet
