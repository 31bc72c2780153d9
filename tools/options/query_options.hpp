// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The words of a query: the same on the command line and in a live session.

#include <optional>
#include <string>
#include <vector>

#include "io/source.hpp"
#include "tools/options/option.hpp"

namespace terratet {
class Ranks;
}

namespace terratet::tools {

struct QueryArguments {
    std::vector<std::string> words;  ///< the verb and where its places are
    std::vector<std::string> at;
    std::string count = "1";
    std::optional<Length> distance;
    std::string box;
    std::string borehole;
    std::string plane;
    std::optional<Length> step;
    std::string above;
    std::string estimator;
    std::string crs;
    std::vector<std::string> columns;
    std::string side = "+";
    std::string time;
    bool probabilities = false;
    bool no_deviation = false;
    const Ranks* ranks = nullptr;  ///< who shares the work; null: nobody
};

std::vector<OptionGroup> query_options(QueryArguments& arguments);

/// From a list of words, as a live session has them. Throws UsageError.
QueryArguments parse_query(const std::vector<std::string>& words);

}  // namespace terratet::tools
