// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The whole of build and of convert: check, read, build, write, account.

#include <string>
#include <vector>

#include "tess/error.hpp"
#include "tools/run/outputs.hpp"
#include "tools/run/pipeline.hpp"

namespace terratet::tools {

struct BuildArguments {
    SiteArguments site;
    ModelArguments model;
    ExportArguments exporting;
    RunArguments run;
    std::vector<std::string> outputs;
};

/// Returns the exit code: 0, or 4 with --strict when criteria stay unmet.
int run_build(const std::string& command, const BuildArguments& arguments, const std::vector<Given>& given);

}  // namespace terratet::tools
