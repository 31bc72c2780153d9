// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Arguments into the targets of a Syntax.

#include <string>
#include <vector>

#include "tools/options/option.hpp"

namespace terratet::tools {

/// An option as the user gave it, on the command line or in the recipe.
struct Given {
    std::string group;
    std::string name;  ///< the option's first one
    std::vector<std::string> values;
};

/// Fills the targets and returns what was given, in order of declaration. Options that neither the command line nor the
/// recipe (--config) names keep their values; the command line wins over the recipe.
///
/// GDAL's habits hold: -t_srs is --t_srs; -te and -tr take their numbers apart or joined by commas. Throws UsageError:
/// an unknown option (with the nearest known one), a missing value, a number that is none, too few or too many
/// arguments, a recipe that cannot be read or names an unknown key.
std::vector<Given> parse_arguments(const Syntax& syntax, const std::vector<std::string>& arguments);

/// GDAL's spelling to ours: one-dash long options to two dashes, numbers that stand apart joined by commas.
std::vector<std::string> with_two_dashes(const Syntax& syntax, const std::vector<std::string>& arguments);

}  // namespace terratet::tools
