// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What was done, for programs (the report, docs/report.md) and for people (the summary).

#include <memory>
#include <string>
#include <vector>

#include "io/export.hpp"
#include "tools/run/outputs.hpp"
#include "tools/run/pipeline.hpp"

namespace terratet::tools {

/// One call that made outputs.
struct RunRecord {
    std::shared_ptr<const ModelSnapshot> model;
    const BuildRecord* build = nullptr;  ///< null: the model was there already
    Written written;
    double write_seconds = 0;
    double total_seconds = 0;
};

/// JSON with the keys of docs/report.md in their order.
std::string report_text(const RunRecord& record);

/// A few lines with everything a person checks first; no line end after the last.
std::string summary_text(const RunRecord& record);

/// To the file, or to standard output for "-".
void write_report(const RunRecord& record, const RunArguments& run);

}  // namespace terratet::tools
