// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/json_usage.hpp"

#include <nlohmann/json.hpp>

#include "tools/options/command.hpp"
#include "tools/version.hpp"

namespace terratet::tools {
namespace {

using Json = nlohmann::ordered_json;

std::string type_of(const Target& target) {
    if (const auto* parsed = std::get_if<Parsed>(&target)) {
        return parsed->type;
    }
    constexpr const char* names[] = {"switch", "text", "number", "count", "text"};  // in the order of Target
    static_assert(std::variant_size_v<Target> == std::size(names) + 1);
    return names[target.index()];
}

Json described(const Option& option) {
    Json names = Json::array();
    for (const auto& name : option.names) {
        names.push_back(dashed(name));
    }
    return {{"names", names},
            {"value", option.value},
            {"type", type_of(option.target)},
            {"words", words_of(option)},
            {"repeatable", is_repeatable(option)},
            {"numbers", option.numbers},
            {"help", help_text(option)}};
}

Json described(const CommandEntry& entry) {
    const auto command = entry.make();
    const Syntax syntax = command->syntax();
    Json groups = Json::array();
    for (const auto& group : syntax.groups) {
        Json options = Json::array();
        for (const auto& option : group.options) {
            options.push_back(described(option));
        }
        groups.push_back({{"title", group.title}, {"options", options}});
    }
    return {{"name", entry.name},
            {"summary", entry.summary},
            {"usage", entry.usage},
            {"description", entry.description},
            {"examples", entry.examples},
            {"arguments",
             {{"name", syntax.positional.name}, {"min", syntax.positional.min}, {"max", syntax.positional.max}}},
            {"groups", groups}};
}

}  // namespace

std::string json_usage() {
    Json list = Json::array();
    for (const auto& entry : commands()) {
        list.push_back(described(entry));
    }
    return Json{{"terratet", version}, {"commands", list}}.dump(2) + "\n";
}

}  // namespace terratet::tools
