// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What options' texts mean: lengths, one word out of a few, numbers with commas, lists. All throw UsageError that says
/// what was found; whoever knows the option puts its name in front.

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/source.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"
#include "tools/options/option.hpp"

namespace terratet::tools {

/// What `understand` gives; the option's name goes in front of what it throws.
template <class Understand>
auto named(const std::string& option, const Understand& understand) {
    try {
        return understand();
    } catch (const UsageError& error) {
        throw UsageError(option + ": " + error.what());
    }
}

std::vector<std::string> split(const std::string& text, char separator);

/// "x,y,z" and the like, from `least` to `most` numbers, each within max_coordinate.
std::vector<double> parse_numbers(const std::string& text, std::size_t least, std::size_t most);

/// The same with the option's name in front of what is thrown.
std::vector<double> option_numbers(const std::string& option, const std::string& text, std::size_t least,
                                   std::size_t most);

/// Above 0. \param or_zero  0 too
Length parse_positive_length(const std::string& text, bool or_zero = false);

/// In the model's unit; 0 if it is not given, where a default is chosen.
double in_unit(const std::optional<Length>& length, double metres_per_unit);

/// An option that is a length above 0. \param or_zero  0 too
Parsed length_value(std::optional<Length>& target, bool or_zero = false);

template <class T>
using Choices = std::vector<std::pair<std::string, T>>;

/// What `word` stands for. Throws UsageError with what there is, and the nearest word.
template <class T>
T choose(const std::string& word, const Choices<T>& choices) {
    const auto found = std::ranges::find(choices, word, &std::pair<std::string, T>::first);
    if (found == choices.end()) {
        const auto names = names_of(choices, &std::pair<std::string, T>::first);
        throw UsageError("'" + word + "' is not one of " + listed(names) + did_you_mean(word, names));
    }
    return found->second;
}

/// An option that is one of a few words; the default is what the target holds.
template <class T>
Parsed one_of(T& target, const Choices<T>& choices) {
    const auto standard = std::ranges::find(choices, target, &std::pair<std::string, T>::second);
    return {.take = [&target, choices](const std::string& word) { target = choose(word, choices); },
            .type = "word",
            .words = names_of(choices, &std::pair<std::string, T>::first),
            .standard = standard == choices.end() ? "" : standard->first};
}

/// An option that may be given several times, each understood by `parse`.
template <class T, class Parse>
Parsed each(std::vector<T>& target, const Parse& parse) {
    return {.take = [&target, parse](const std::string& text) { target.push_back(parse(text)); }, .repeatable = true};
}

/// An option that is understood by `parse`.
template <class T, class Parse>
Parsed single(T& target, const Parse& parse) {
    return {.take = [&target, parse](const std::string& text) { target = parse(text); }};
}

}  // namespace terratet::tools
