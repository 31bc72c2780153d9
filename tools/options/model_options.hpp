// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What to build: the options behind tess/build.hpp. Lengths stay text until the unit of the model's CRS is known.

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "interp/estimator_spec.hpp"
#include "tess/build.hpp"
#include "tools/options/option.hpp"

namespace terratet::tools {

/// Not given: as many as the memory is thought to hold.
inline constexpr auto fitting_vertices = std::numeric_limits<std::uint64_t>::max();

struct ModelArguments {
    std::string extent;
    std::string pad;
    std::string l_min;
    std::string l_max;
    std::vector<std::string> resolution;
    std::vector<std::string> df_min;
    std::vector<std::string> df_max;
    std::vector<std::string> tolerance;
    std::string l_min_floor;
    std::string shape = "needed";
    double radius_edge = Criteria{}.radius_edge;
    double aspect = Criteria{}.aspect;
    double dihedral_deg = Criteria{}.dihedral_deg;
    double v_min = 0;
    double v_max = 0;
    std::string horizon = "soft";
    std::vector<std::string> region_names;
    std::string density = "canonical";
    std::string fault_mode = "paired";
    std::string fault_spacing;
    std::string fault_width;
    std::string fault_snap;
    bool fault_refine = false;
    std::string estimator = EstimatorSpec{}.name;
    std::uint64_t max_vertices = fitting_vertices;
};

std::vector<OptionGroup> model_options(ModelArguments& arguments);

/// Everything that can be refused before the inputs are read: words, numbers, contradictions. Throws UsageError.
void check_model_arguments(const ModelArguments& arguments);

Option horizon_option(std::string& horizon);

/// Notes in the site's properties which of them horizons bar. \param horizon  soft, hard, or hard=P,Q. Throws
/// UsageError for anything else, or a property there is none of.
void set_horizons(const std::string& horizon, Site& site);

/// What --max-vertices is where it is not given.
std::uint64_t fitting_vertex_limit();

/// In the frame and with the properties of `site`. Throws UsageError: also for a property there is none of.
BuildOptions build_options(const ModelArguments& arguments, const Site& site);

}  // namespace terratet::tools
