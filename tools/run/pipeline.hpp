// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// From arguments to a model: what build and convert share.

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "interp/estimator_spec.hpp"
#include "interp/live_model.hpp"
#include "io/read_site.hpp"
#include "tools/options/model_options.hpp"
#include "tools/options/run_options.hpp"
#include "tools/options/site_options.hpp"

namespace terratet::tools {

/// What happened on the way, for the report and the summary.
struct BuildRecord {
    ReadCounts counts;
    Diagnostics diagnostics;  ///< of reading and of building
    BuildReport report;
    EstimatorSpec estimator;
    std::vector<std::pair<std::string, std::string>> defaults;  ///< option and value, of those left to be chosen
    std::map<std::string, double> seconds;
};

/// Refuses what can be refused without reading anything. Throws UsageError.
void check_before_reading(const SiteArguments& site, const ModelArguments& model, const RunArguments& run);

LiveModel read_and_build(const SiteArguments& site, const ModelArguments& model, const RunArguments& run,
                         const Progress& progress, BuildRecord& record);

/// Bad cells that no exemption covers: what --strict turns into exit code 4.
std::uint64_t unmet_cells(const RefineReport& report);

}  // namespace terratet::tools
