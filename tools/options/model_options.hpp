// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What to build: the options behind tess/build.hpp. Lengths keep their own unit until that of the model's CRS is
/// known.

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "interp/estimator_spec.hpp"
#include "io/source.hpp"
#include "tess/build.hpp"
#include "tools/options/option.hpp"
#include "tools/options/tolerance_option.hpp"

namespace terratet::tools {

/// Not given: as many as the memory is thought to hold.
inline constexpr auto fitting_vertices = std::numeric_limits<std::uint64_t>::max();

/// Another resolution in a part.
struct GivenResolution {
    ResolutionOverride part;  ///< in true coordinates, without its lengths
    Length l_min;
    Length l_max;
};

/// "P=V"
struct PropertyLimit {
    std::string property;
    double limit = 0;
};

/// Which properties horizons bar: none, all, or those named.
struct HardHorizons {
    bool all = false;
    std::vector<std::string> properties;
};

struct ModelArguments {
    BuildOptions build;          ///< what needs neither a unit nor a frame; its defaults are those of the options
    std::optional<Box3> extent;  ///< in true coordinates
    std::optional<Length> pad;
    std::optional<Length> l_min;
    std::optional<Length> l_max;
    std::optional<Length> l_min_floor;
    std::vector<GivenResolution> resolution;
    std::vector<PropertyLimit> df_min;
    std::vector<PropertyLimit> df_max;
    std::vector<AskedTolerance> tolerance;
    HardHorizons horizon;
    std::vector<RegionName> region_names;  ///< in true coordinates
    std::optional<Length> fault_spacing;
    std::optional<Length> fault_width;
    std::optional<Length> fault_snap;
    EstimatorSpec estimator;
    std::uint64_t max_vertices = fitting_vertices;
};

std::vector<OptionGroup> model_options(ModelArguments& arguments);

/// Contradictions that need no data: lengths are compared where all have a unit of their own, or none. Throws
/// UsageError.
void check_model_arguments(const ModelArguments& arguments);

/// "soft", "hard" or "hard=P,Q". Throws UsageError.
HardHorizons parse_horizon(const std::string& text);

/// \param target  `--horizon`
Option horizon_option(Parsed target);

/// Notes in the site's properties which of them horizons bar. Throws UsageError for a property there is none of.
void set_horizons(const HardHorizons& horizon, Site& site);

/// What --max-vertices is where it is not given.
std::uint64_t fitting_vertex_limit();

/// In the frame and with the properties of `site`. Throws UsageError: also for a property there is none of.
BuildOptions build_options(const ModelArguments& arguments, const Site& site);

}  // namespace terratet::tools
