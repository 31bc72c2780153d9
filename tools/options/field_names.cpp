// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/field_names.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "tools/options/command.hpp"

namespace terratet::tools {
namespace {

/// Of all commands, without dashes.
std::set<std::string> declared_options() {
    std::set<std::string> names;
    for (const CommandEntry& entry : commands()) {
        const auto command = entry.make();
        for (const OptionGroup& group : command->syntax().groups) {
            for (const Option& option : group.options) {
                names.insert(option.names.begin(), option.names.end());
            }
        }
    }
    return names;
}

/// Without dashes in front; there need not be such an option.
std::string option_name(std::string_view field) {
    static const std::map<std::string_view, const char*> exceptions{
        {"l_min", "lmin"},
        {"l_max", "lmax"},
        {"v_min", "vmin"},
        {"v_max", "vmax"},
        {"logs", "log"},
        {"nulls", "null"},
        {"surveys", "survey"},
        {"surfaces", "surface"},
        {"properties", "property"},
        {"format", "of"},
        {"dip", "dip-convention"},
        {"dihedral_deg", "dihedral"},
        {"overrides", "resolution"},
        {"region_names", "region-name"},
    };
    if (const auto found = exceptions.find(field); found != exceptions.end()) {
        return found->second;
    }
    constexpr std::string_view of_barriers = "barriers.";
    std::string name =
        field.starts_with(of_barriers) ? "fault-" + std::string(field.substr(of_barriers.size())) : std::string(field);
    std::ranges::replace(name, '_', '-');
    return name;
}

bool is_field(std::string_view name) {
    return !name.empty() &&
           std::ranges::all_of(name, [](char c) { return (c >= 'a' && c <= 'z') || c == '_' || c == '.'; });
}

/// Does a name that follows name a record of a file?
bool speaks_of_record(std::string_view before) {
    constexpr std::array<std::string_view, 4> kinds{"layer ", "column ", "trigger ", "index "};
    return std::ranges::any_of(kinds, [&](std::string_view kind) { return before.ends_with(kind); });
}

}  // namespace

std::string with_options(std::string_view text) {
    static const std::set<std::string> declared = declared_options();
    std::string out;
    std::size_t at = 0;
    while (true) {
        const std::size_t open = text.find('`', at);
        const std::size_t close = open == std::string_view::npos ? open : text.find('`', open + 1);
        if (close == std::string_view::npos) {
            return out += text.substr(at);
        }
        const std::string_view name = text.substr(open + 1, close - open - 1);
        const std::size_t behind = is_field(name) ? close + 1 : close;  // else the second may open a field
        const std::string option = option_name(name);
        if (is_field(name) && declared.contains(option) && !speaks_of_record(text.substr(0, open))) {
            out += text.substr(at, open - at);
            out += dashed(option);
        } else {
            out += text.substr(at, behind - at);
        }
        at = behind;
    }
}

}  // namespace terratet::tools
