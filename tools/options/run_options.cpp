// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/run_options.hpp"

#include "tools/options/values.hpp"

namespace terratet::tools {

std::vector<OptionGroup> run_options(RunArguments& a) {
    return {{run_group,
             {
                 {{"overwrite"}, "", "replace outputs that exist", &a.overwrite},
                 {{"strict"}, "", "refuse dirty records (exit 3); exit 4 when criteria stay unmet", &a.strict},
                 {{"report"}, "FILE.json", "write what was done, in numbers; - for standard output", &a.report},
                 {{"config"}, "FILE.toml", "a recipe with any of these options, as lmin = \"20m\"", &a.config},
                 threads_option(a.threads),
                 progress_option(a.progress),
                 {{"q", "quiet"}, "", "no summary", &a.quiet},
             }}};
}

Option threads_option(std::uint64_t& threads) {
    return {{"threads"}, "N", "as many as there are cores by default; results don't depend on it", &threads};
}

Option progress_option(ProgressStyle& progress) {
    return {{"progress"},
            "HOW",
            "auto (default: a bar on a terminal), none, json (lines on standard error)",
            one_of(progress,
                   {{"auto", ProgressStyle::automatic}, {"none", ProgressStyle::none}, {"json", ProgressStyle::json}})};
}

}  // namespace terratet::tools
