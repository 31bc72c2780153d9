// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One word out of a few.

#include <string>
#include <utility>
#include <vector>

#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet::tools {

/// What `word` stands for. Throws UsageError that names the option, the nearest word, and what there is.
template <class T>
T choose(const std::string& option, const std::string& word, const std::vector<std::pair<std::string, T>>& choices) {
    std::vector<std::string> names;
    for (const auto& [name, value] : choices) {
        if (name == word) {
            return value;
        }
        names.push_back(name);
    }
    throw UsageError(option + ": '" + word + "' is not one of " + listed(names) + did_you_mean(word, names));
}

}  // namespace terratet::tools
