// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Numbers that people dress up in their cells: "12 %", "1.2 g/t", "−1.5", "1.2±0.1", "1.0D-08", "2.0×10^-8".

#include <string>
#include <string_view>
#include <vector>

#include "io/base/text_column.hpp"

namespace terratet {

/// A column whose cells were brought to plain numbers, decimal and thousands signs left as they are.
struct PlainColumn {
    TextColumn cells;
    std::string unit{};                ///< that the cells carry; empty: none
    std::vector<std::string> forms{};  ///< what was done, in words
};

/// A unit is taken off where at least half of the numbers carry it and none carries another: a percentage among plain
/// numbers stays what it is, no number. `is_number` says what is a plain one, bounds (<0.5) included. Unchanged, and
/// without forms, where nothing is to be done. O(cells).
PlainColumn plain_column(const TextColumn& column, bool (*is_number)(std::string_view));

}  // namespace terratet
