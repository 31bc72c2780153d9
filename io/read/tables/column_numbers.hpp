// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A column's cells as numbers, each looked at once.

#include <cstdint>
#include <string_view>
#include <vector>

#include "io/base/text_column.hpp"
#include "tess/samples.hpp"

namespace terratet {

/// Empty, NA, N/A, NaN, null, none, -: no value, and no text either.
bool is_null_word(std::string_view text);

struct Numbers {
    std::vector<double> values;          ///< a row each; missing where there is none
    std::vector<Censoring> censored{};   ///< of each value; empty: none is a bound
    std::vector<std::uint32_t> words{};  ///< rows whose text is neither a number nor a word for none
    std::size_t count = 0;               ///< of numbers and bounds
    [[nodiscard]] std::size_t filled() const { return count + words.size(); }
};

/// O(cells).
Numbers numbers_of(const TextColumn& column);

}  // namespace terratet
