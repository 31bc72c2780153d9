// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/run_options.hpp"

namespace terratet::tools {

std::vector<OptionGroup> run_options(RunArguments& a) {
    return {{run_group,
             {
                 {{"overwrite"}, "", "replace outputs that exist", &a.overwrite},
                 {{"strict"}, "", "refuse dirty records (exit 3); exit 4 when criteria stay unmet", &a.strict},
                 {{"report"}, "FILE.json", "write what was done, in numbers; - for standard output", &a.report},
                 {{"config"}, "FILE.toml", "a recipe with any of these options, as lmin = \"20m\"", &a.config},
                 {{"threads"}, "N", "as many as there are cores by default; results don't depend on it", &a.threads},
                 {{"progress"},
                  "HOW",
                  "auto (default: a bar on a terminal), none, json (lines on standard error)",
                  &a.progress},
                 {{"q", "quiet"}, "", "no summary", &a.quiet},
             }}};
}

}  // namespace terratet::tools
