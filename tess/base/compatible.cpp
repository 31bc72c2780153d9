// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/base/compatible.hpp"

#include <algorithm>
#include <set>

namespace terratet {

std::vector<char> compatible(std::vector<std::vector<std::uint32_t>> conflicts) {
    std::set<std::pair<std::size_t, std::uint32_t>> troubled;  // by the number of conflicts with those still there
    std::vector<std::size_t> degree(conflicts.size(), 0);
    for (std::uint32_t i = 0; i < conflicts.size(); ++i) {
        std::ranges::sort(conflicts[i]);
        conflicts[i].erase(std::ranges::unique(conflicts[i]).begin(), conflicts[i].end());
        degree[i] = conflicts[i].size();
        if (degree[i] > 0) {
            troubled.emplace(degree[i], i);
        }
    }
    std::vector<char> there(conflicts.size(), 1);
    std::vector<std::uint32_t> gone;
    while (!troubled.empty()) {
        const std::uint32_t worst = troubled.rbegin()->second;
        troubled.erase(std::prev(troubled.end()));
        there[worst] = 0;
        gone.push_back(worst);
        for (const std::uint32_t other : conflicts[worst]) {
            if (there[other] != 0) {
                troubled.erase({degree[other], other});
                if (--degree[other] > 0) {
                    troubled.emplace(degree[other], other);
                }
            }
        }
    }
    std::ranges::reverse(gone);
    for (const std::uint32_t i : gone) {
        there[i] = std::ranges::none_of(conflicts[i], [&](std::uint32_t other) { return there[other] != 0; }) ? 1 : 0;
    }
    return there;
}

}  // namespace terratet
