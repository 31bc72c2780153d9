// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/command_line.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "io/base/network.hpp"
#include "io/read/tables/read_table.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"
#include "tools/options/text.hpp"
#include "tools/options/values.hpp"

namespace terratet::tools {
namespace {

using Values = std::map<const Option*, std::vector<std::string>>;

template <class Visitor>
void for_each_option(const Syntax& syntax, Visitor visit) {
    for (const auto& group : syntax.groups) {
        for (const auto& option : group.options) {
            visit(group, option);
        }
    }
}

const Option* find_option(const Syntax& syntax, const std::string& name) {
    const Option* found = nullptr;
    for_each_option(syntax, [&](const OptionGroup&, const Option& option) {
        if (std::find(option.names.begin(), option.names.end(), name) != option.names.end()) {
            found = &option;
        }
    });
    return found;
}

std::string suggestion(const Syntax& syntax, const std::string& word, bool with_dashes) {
    std::vector<std::string> names;
    for_each_option(syntax, [&](const OptionGroup&, const Option& option) {
        names.insert(names.end(), option.names.begin(), option.names.end());
    });
    const std::string nearest = nearest_word(word, names);
    return nearest.empty() ? fmt::format("; 'terratet help {}' lists the options", syntax.command)
                           : fmt::format("; did you mean {}?", with_dashes ? dashed(nearest) : nearest);
}

[[noreturn]] void refuse_extra(const Syntax& syntax, const std::string& argument) {
    if (argument.size() > 1 && argument.front() == '-') {
        const std::string name = argument.substr(argument.find_first_not_of('-'), argument.find('=')).substr(0, 40);
        throw UsageError(fmt::format("unknown option {}{}", argument, suggestion(syntax, name, true)));
    }
    if (syntax.positional.max == 0) {
        throw UsageError(
            fmt::format("'{}' is not expected: {} takes its inputs and output by options; see 'terratet help {}'",
                        argument, syntax.command, syntax.command));
    }
    throw UsageError(fmt::format("'{}' is one argument too many; see 'terratet help {}'", argument, syntax.command));
}

/// CLI11 sorts the arguments; what they mean is decided in assign(), the same for the command line and for a recipe.
Values sort_arguments(const Syntax& syntax, const std::vector<std::string>& arguments) {
    CLI::App app("", "terratet " + syntax.command);
    app.set_help_flag();
    Values values;
    for_each_option(syntax, [&](const OptionGroup&, const Option& option) {
        std::string names;
        for (const auto& name : option.names) {
            names += (names.empty() ? "" : ",") + dashed(name);
        }
        if (is_switch(option)) {
            app.add_flag_callback(names, [&] { values[&option] = {"true"}; });
        } else {
            auto* added = app.add_option(names, [&](const CLI::results_t& results) {
                values[&option] = results;
                return true;
            });
            added->expected(1)->allow_extra_args(false)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        }
    });
    std::vector<std::string> rest;
    if (syntax.positional.max > 0) {
        app.add_option(syntax.positional.name, rest);
    }
    try {
        std::vector<std::string> reversed(arguments.rbegin(), arguments.rend());
        app.parse(reversed);
    } catch (const CLI::ExtrasError&) {
        const auto extras = app.remaining();
        const auto option = std::find_if(extras.begin(), extras.end(), [](const auto& e) { return e.front() == '-'; });
        refuse_extra(syntax, option != extras.end() ? *option : extras.front());
    } catch (const CLI::ArgumentMismatch& error) {
        const std::string what = error.what();
        throw UsageError(
            fmt::format("{} needs a value; see 'terratet help {}'", what.substr(0, what.find(':')), syntax.command));
    } catch (const CLI::ParseError& error) {
        throw UsageError(one_line(error.what()));
    }
    if (static_cast<int>(rest.size()) < syntax.positional.min) {
        const bool several = syntax.positional.name.find(" and ") != std::string::npos;
        throw UsageError(fmt::format("{} {}; usage: 'terratet help {}'", syntax.positional.name,
                                     several ? "are needed" : "is missing", syntax.command));
    }
    if (static_cast<int>(rest.size()) > syntax.positional.max) {
        refuse_extra(syntax, rest[static_cast<std::size_t>(syntax.positional.max)]);
    }
    if (syntax.positional.target != nullptr) {
        *syntax.positional.target = rest;
    }
    return values;
}

void add_recipe(const Syntax& syntax, const std::string& path, Values& values) {
    std::vector<CLI::ConfigItem> items;
    try {
        items = CLI::ConfigTOML().from_file(path);
    } catch (const CLI::Error&) {
        throw UsageError(fmt::format("{}: the recipe cannot be read", path));
    }
    const Values from_command_line = values;
    for (const auto& item : items) {
        if (!item.parents.empty() || item.name == "++" || item.name == "--") {
            throw UsageError(fmt::format("{}: a recipe has no sections: write the options at the top level", path));
        }
        const Option* option = find_option(syntax, item.name);
        if (option == nullptr || item.name == "config") {
            throw UsageError(
                fmt::format("{}: unknown option '{}'{}", path, item.name, suggestion(syntax, item.name, false)));
        }
        // A recipe is a file too: what it would have called is told, and called only when the command line asks for it.
        const auto remote = std::find_if(item.inputs.begin(), item.inputs.end(), names_network);
        if (remote != item.inputs.end() && !from_command_line.contains(option)) {
            throw UsageError(fmt::format("{}: {} = {} is on a network; name it on the command line, with {}", path,
                                         item.name, *remote, dashed(option->names.front())));
        }
        if (!from_command_line.contains(option)) {
            values[option] = item.inputs;
        }
    }
}

double as_number(const std::string& name, const std::string& text) {
    const auto number = parse_number(text);
    if (!number) {
        throw UsageError(fmt::format("{}: '{}' is not a number", name, text));
    }
    return *number;
}

bool as_switch(const std::string& name, const std::string& text) {
    if (text != "true" && text != "false") {
        throw UsageError(fmt::format("{}: '{}' is neither true nor false", name, text));
    }
    return text == "true";
}

void assign(const Option& option, const std::vector<std::string>& values) {
    const std::string name = dashed(option.names.back());  // the one in words
    if (auto* const* texts = std::get_if<std::vector<std::string>*>(&option.target)) {
        **texts = values;
        return;
    }
    if (values.size() != 1 && !is_repeatable(option)) {
        throw UsageError(fmt::format("{} is given {} times; it takes one value", name, values.size()));
    }
    if (const auto* parsed = std::get_if<Parsed>(&option.target)) {
        for (const std::string& text : values) {
            named(name, [&] { parsed->take(text); });
        }
        return;
    }
    const std::string& text = values.front();
    if (auto* const* target = std::get_if<bool*>(&option.target)) {
        **target = as_switch(name, text);
    } else if (auto* const* number = std::get_if<double*>(&option.target)) {
        **number = as_number(name, text);
    } else if (auto* const* count = std::get_if<std::uint64_t*>(&option.target)) {
        const double value = as_number(name, text);
        if (value < 0 || value > 1e15 || value != std::floor(value)) {
            throw UsageError(fmt::format("{}: '{}' is not a whole number from 0", name, text));
        }
        **count = static_cast<std::uint64_t>(value);
    } else {
        *std::get<std::string*>(option.target) = text;
    }
}

}  // namespace

std::vector<std::string> with_two_dashes(const Syntax& syntax, const std::vector<std::string>& arguments) {
    std::vector<std::string> out;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        std::string argument = arguments[i];
        if (argument.size() < 2 || argument.front() != '-') {
            out.push_back(std::move(argument));
            continue;
        }
        const std::string name = argument.substr(argument.find_first_not_of('-') == 2 ? 2 : 1, argument.find('='));
        const std::string bare = name.substr(0, name.find('='));
        const Option* option = find_option(syntax, bare);
        if (option != nullptr && bare.size() > 1 && argument[1] != '-') {
            argument.insert(0, "-");
        }
        out.push_back(std::move(argument));
        if (option == nullptr || option->numbers == 1) {
            continue;
        }
        std::string joined;
        for (int k = 0; k < option->numbers && i + 1 < arguments.size() && parse_number(arguments[i + 1]); ++k) {
            joined += (joined.empty() ? "" : ",") + arguments[++i];
        }
        if (!joined.empty()) {
            out.push_back(std::move(joined));
        }
    }
    return out;
}

std::vector<Given> parse_arguments(const Syntax& syntax, const std::vector<std::string>& arguments) {
    Values values = sort_arguments(syntax, with_two_dashes(syntax, arguments));
    if (const Option* config = find_option(syntax, "config"); config != nullptr && values.contains(config)) {
        add_recipe(syntax, values[config].back(), values);
    }
    std::vector<Given> given;
    for_each_option(syntax, [&](const OptionGroup& group, const Option& option) {
        if (const auto found = values.find(&option); found != values.end()) {
            assign(option, found->second);
            given.push_back({group.title, option.names.front(), found->second});
        }
    });
    return given;
}

}  // namespace terratet::tools
