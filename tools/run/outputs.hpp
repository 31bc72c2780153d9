// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The outputs of one call: refused before any work where they can be, written one after the other.

#include <optional>
#include <string>
#include <vector>

#include "io/export.hpp"
#include "io/model_store.hpp"
#include "tools/options/command_line.hpp"
#include "tools/options/export_options.hpp"
#include "tools/options/run_options.hpp"

namespace terratet::tools {

/// Is one of them of voxels, and a file?
bool any_voxels(const std::vector<std::string>& outputs, const ExportArguments& arguments);

/// A GeoPackage or a PostGIS connection string.
bool names_model(const std::string& path);

/// Throws UsageError for an unknown format, a path given twice, or one that is an input too, the
/// report among them; Error for a missing folder or a file that exists without --overwrite.
void check_outputs(const std::vector<std::string>& paths, const std::vector<std::string>& inputs,
                   const ExportArguments& arguments, const RunArguments& run);

/// The same for outputs of other kinds: `paths` and the report.
void check_places(std::vector<std::string> paths, const std::vector<std::string>& inputs, const RunArguments& run);

/// What was written, and how the faults were collapsed for it.
struct Written {
    std::vector<OutputRecord> outputs;
    std::optional<CollapseReport> collapse;
};

/// A line an output of voxels: what it will take. Throws UsageError for what is too large without --allow-large.
std::vector<std::string> plan_lines(const ModelSnapshot& model, const std::vector<std::string>& paths,
                                    const ExportArguments& arguments);

/// Says it before anything is written; on standard output, and true, where that is all that is asked for.
bool say_plan(const ModelSnapshot& model, const std::vector<std::string>& paths, const ExportArguments& arguments);

/// Writes all of `paths`: models through `entry`, the rest through their writers. An error names what was written
/// before.
Written write_outputs(const ModelSnapshot& model, const std::vector<std::string>& paths,
                      const ExportArguments& arguments, const RunArguments& run, const JournalEntry& entry,
                      const Progress& progress);

/// For the journal: what was asked, without what only says how to run. The time is SOURCE_DATE_EPOCH's when set.
JournalEntry journal_entry(const std::string& command, const std::vector<Given>& given);

}  // namespace terratet::tools
