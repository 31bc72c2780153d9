// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How to run: options that never change a result.

#include <cstdint>
#include <string>
#include <vector>

#include "tools/options/option.hpp"

namespace terratet {
class Ranks;
}

namespace terratet::tools {

enum class ProgressStyle { automatic, none, json };

struct RunArguments {
    std::uint64_t threads = 0;  ///< 0: as many as there are cores
    std::string config;
    std::string report;
    ProgressStyle progress = ProgressStyle::automatic;
    bool overwrite = false;
    bool strict = false;
    bool quiet = false;
    const Ranks* ranks = nullptr;  ///< who shares the work; null: nobody
};

/// The title of the group: what the journal leaves out.
inline constexpr const char* run_group = "Running";

std::vector<OptionGroup> run_options(RunArguments& arguments);

Option threads_option(std::uint64_t& threads);
Option progress_option(ProgressStyle& progress);

}  // namespace terratet::tools
