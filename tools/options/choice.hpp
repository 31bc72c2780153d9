// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One word out of a few.

#include <string>
#include <utility>
#include <vector>

#include "tess/error.hpp"
#include "tools/options/text.hpp"

namespace terratet::tools {

/// What `word` stands for. Throws UsageError that names the option, the nearest word, and what there is.
template <class T>
T choose(const std::string& option, const std::string& word, const std::vector<std::pair<std::string, T>>& choices) {
    std::string known;
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) {
        if (name == word) {
            return value;
        }
        known += (known.empty() ? "" : ", ") + name;
        names.push_back(name);
    }
    const std::string nearest = nearest_word(word, names);
    throw UsageError(option + ": '" + word + "' is not one of " + known +
                     (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
}

}  // namespace terratet::tools
