// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Names of properties in a file that has names of its own.

#include <algorithm>
#include <span>
#include <string>
#include <vector>

namespace terratet {

/// The names as they are, but where one is taken, by the format or by a name before it, followed by _2, _3, …
inline std::vector<std::string> distinct_names(std::vector<std::string> names, std::span<const char* const> taken) {
    std::vector<std::string> used(taken.begin(), taken.end());
    for (std::string& name : names) {
        const std::string wanted = name;
        for (int n = 2; std::find(used.begin(), used.end(), name) != used.end(); ++n) {
            name = wanted + "_" + std::to_string(n);
        }
        used.push_back(name);
    }
    return names;
}

}  // namespace terratet
