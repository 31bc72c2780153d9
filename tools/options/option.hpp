// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One option, declared once: its names on the command line and in a recipe, its help, and where its value goes. The
/// parser (command_line.hpp), the help (help.hpp) and the pages in docs/commands all read the same declaration.

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace terratet::tools {

/// A value that is understood once, where it is given (values.hpp has those for lengths, words and lists).
struct Parsed {
    std::function<void(const std::string& text)> take;  ///< throws UsageError that says what is wrong with the text
    std::string type = "text";                          ///< for --json-usage
    bool repeatable = false;                            ///< then `take` is called for each
    std::vector<std::string> words{};                   ///< what it may be, where those are few; completion offers them
    std::string standard{};                             ///< which of them holds if none is given
};

/// Where a value goes. A vector makes the option repeatable; a bool makes it a switch.
using Target = std::variant<bool*, std::string*, double*, std::uint64_t*, std::vector<std::string>*, Parsed>;

struct Option {
    std::vector<std::string> names;  ///< without dashes; the first one leads in the help; one letter: a short option
    std::string value;               ///< what the help calls the value: "FILE"; empty for a switch
    std::string help;
    Target target;
    int numbers = 1;  ///< may be given as this many numbers apart from each other, as in -te XMIN YMIN …
};

bool is_switch(const Option& option);
bool is_repeatable(const Option& option);

/// What it may be, where those are few.
const std::vector<std::string>& words_of(const Option& option);

/// Its help with the default, which is what its target holds before anything is given: "(default)" behind the word in
/// force, "Default 8" of a number. Of none, and where the help tells of it itself, nothing is added.
std::string help_text(const Option& option);

struct OptionGroup {
    std::string title;
    std::vector<Option> options;
};

/// What stands on a command line without a name.
struct Positional {
    std::string name;  ///< "OUTPUT"; empty: the command takes none
    int min = 0;
    int max = 0;
    std::vector<std::string>* target = nullptr;
};

/// Everything a command understands.
struct Syntax {
    std::string command;
    std::vector<OptionGroup> groups;
    Positional positional;
};

/// Adds groups to a syntax, in order.
void append(Syntax& syntax, std::vector<OptionGroup> groups);

/// "--lmin", "-q".
std::string dashed(const std::string& name);

}  // namespace terratet::tools
