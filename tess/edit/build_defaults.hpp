// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What a build takes where nothing is given: resolution, extent, the outline of the domain.

#include "tess/build_options.hpp"

namespace terratet {

/// The polygon that bounds the model in plan, if there is one.
const Surface* domain_surface(const Site& site);

/// Fills in criteria, domain outline, extent and hull (without faults). Resolution follows from the data's box without
/// what lies far off (tess/site/site_box.hpp), which is noted; so does the extent: padded by l_max in plan, but at most
/// by half the data's diagonal, and vertically by a quarter of the data's height, but at least l_min and at most l_max;
/// by l_max for data without height. Throws InputError when there is nothing to build from, UsageError for criteria
/// that contradict each other and for an extent thinner than l_min.
void resolve_resolution(const BuildOptions& options, Model& model, BuildReport& report);

}  // namespace terratet
