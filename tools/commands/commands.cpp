// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include <fmt/format.h>

#include "tess/base/words.hpp"
#include "tess/error.hpp"
#include "tools/options/command.hpp"
#include "tools/options/edit_options.hpp"

namespace terratet::tools {

const std::vector<CommandEntry>& commands() {
    static const std::vector<CommandEntry> table{
        build_command(), convert_command(), export_command(),   info_command(),     check_command(),     edit_command(),
        query_command(), live_command(),    validate_command(), resample_command(), completion_command()};
    return table;
}

const CommandEntry& find_command(const std::string& name) {
    std::vector<std::string> names;
    for (const auto& entry : commands()) {
        if (entry.name == name) {
            return entry;
        }
        names.push_back(entry.name);
    }
    if (name.starts_with('-')) {
        throw UsageError(fmt::format("unknown option {}{}; a command comes first: 'terratet help' lists them", name,
                                     did_you_mean(name, {"--help", "--version", "--json-usage"})));
    }
    if (std::ranges::find(edit_verbs(), name) != edit_verbs().end() || name == "undo" || name == "redo") {
        throw UsageError(fmt::format("'{0}' is an edit of a model: terratet edit MODEL.gpkg {0} …", name));
    }
    const std::string meant = did_you_mean(name, names);
    throw UsageError(
        fmt::format("unknown command '{}'{}", name, meant.empty() ? "; 'terratet help' lists them" : meant));
}

}  // namespace terratet::tools
