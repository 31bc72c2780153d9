// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What estimators there are, with their options: the one table that parsing, help and documentation read.

#include <limits>
#include <string>
#include <vector>

namespace terratet {

struct EstimatorOption {
    std::string name;
    std::string default_value;  ///< empty: none, or fitted to the samples; of a flag: off
    std::string unit;           ///< "length", "degrees", "value²", …; empty: a plain number or a word
    std::string help;

    /// What a value may be: one of the words; or a number from `lowest` to `highest`, above it where `above`.
    std::vector<std::string> words{};
    double lowest = -std::numeric_limits<double>::max();
    double highest = std::numeric_limits<double>::max();
    bool above = false;
    bool whole = false;
    bool flag = false;     ///< given by its name alone
    bool implied = false;  ///< its default switches something off and is not written out in records
};

struct EstimatorMethod {
    std::string name;
    std::string help;
    std::vector<EstimatorOption> options;  ///< in the order they are written
};

/// In the order of the help; the first is the default.
const std::vector<EstimatorMethod>& estimator_catalogue();

/// Throws UsageError that lists what there is.
const EstimatorMethod& estimator_method(const std::string& name);

/// What a value must be, for messages: "a whole number from 1 to 100000".
std::string wanted(const EstimatorOption& option);

}  // namespace terratet
