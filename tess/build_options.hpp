// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What a build is asked for, and what it says of itself.

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tess/cell_statistics.hpp"
#include "tess/density.hpp"
#include "tess/diagnostics.hpp"
#include "tess/fidelity.hpp"
#include "tess/model.hpp"
#include "tess/refinement.hpp"

namespace terratet {

struct BuildOptions {
    Box3 extent;        ///< frame-local; empty: the samples' and boreholes' box, padded by `pad`
    double pad = -1;    ///< negative: l_max in plan, a quarter of the data's height (l_min to l_max) vertically
    Criteria criteria;  ///< l_min 0: the data's diagonal/100, those far off left out (site_box.hpp); l_max 0: 4 l_min
    /// Chooses a tolerance for each property, where neither l_min nor a tolerance nor a df_max is given and density is
    /// canonical.
    bool default_tolerance = true;
    /// What noise the estimator leaves in a property's field once it is fitted, in the property's scale; infinity where
    /// its field is no matter of cells (nearest). Empty: none.
    std::function<double(const Property&)> estimator_noise;
    DensityMode density = DensityMode::canonical;
    std::vector<RegionName> region_names;  ///< points frame-local
    BarrierOptions barriers;
    /// The spacing is chosen: faults that run side by side and nowhere meet lower it where affordable, few samples for
    /// many seeds widen it (tess/edit/default_spacing.hpp).
    bool separate_faults = false;
    RefineOptions refine;
    bool refine_enabled = true;  ///< false stops after the initial tessellation
    std::string estimator;       ///< recorded in the model; the source below does the work
};

struct BuildReport {
    std::size_t coincident = 0;      ///< samples merged
    std::size_t outside_extent = 0;  ///< samples beyond a given extent: they feed the estimator only
    DensityResult density;
    std::vector<BarrierAccount> barriers;
    std::size_t seeds = 0;
    std::size_t domain_vertices = 0;
    CellStatistics initial;
    RefineReport refine;
    CellStatistics final;
    std::size_t fault_crossing_edges = 0;
    std::vector<Fidelity> fidelity;
    std::vector<EmptyBlock> empty_blocks;
    std::uint64_t fallbacks = 0;            ///< values that the estimator found in a slower or simpler way
    std::map<std::string, double> seconds;  ///< density, boundary, refine, estimate
    Diagnostics diagnostics;
};

}  // namespace terratet
