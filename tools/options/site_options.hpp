// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What to read: the options behind io/read_site.hpp.

#include <optional>
#include <string>
#include <vector>

#include "io/read/tables/read_table.hpp"
#include "io/read_site.hpp"
#include "tools/options/option.hpp"

namespace terratet::tools {

struct SiteArguments {
    std::vector<std::string> boreholes;
    std::vector<std::string> surveys;
    std::vector<std::string> logs;
    std::vector<std::string> samples;
    std::vector<std::string> faults;
    std::vector<std::string> surfaces;
    std::vector<std::string> topography;
    std::string domain;
    std::string time_column;
    std::vector<std::string> properties;
    std::vector<std::string> columns;
    std::string source_crs;
    std::string target_crs;
    SiteInputs inputs;  ///< what is a word or a number there too; its defaults are those of the options
    std::vector<std::string> nulls;
    std::optional<Length> composite;
    std::string layer;
    std::string where;
    std::string sql;
    std::vector<std::string> open_options;
};

std::vector<OptionGroup> site_options(SiteArguments& arguments);

/// Those of site_options that say what boreholes are, for commands that look at nothing else.
std::vector<OptionGroup> hole_options(SiteArguments& arguments);

/// Of --columns MEANING=COLUMN. Throws UsageError.
ColumnNames column_names(const std::vector<std::string>& texts);

/// Throws UsageError: no input at all, a word that is no choice, --layer, --where or --sql with several inputs.
SiteInputs site_inputs(const SiteArguments& arguments, bool strict);

/// All files that are named as inputs, as they were given.
std::vector<std::string> input_paths(const SiteArguments& arguments);

/// Composites the logs if --composite asks for it (interp/plan/composite.hpp), and notes what came of it.
void composite_as_asked(Site& site, const SiteArguments& arguments, Diagnostics& diagnostics);

}  // namespace terratet::tools
