// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How people write numbers: decimal commas, and signs between the thousands.

#include <cstdint>
#include <string>
#include <string_view>

#include "io/base/table.hpp"

namespace terratet {

/// What parts the thousands, and what the whole from its parts of ten. Thousands are parted by apostrophes (' ’), by
/// blanks (also no-break and narrow ones), by commas or by points, in groups of exactly three.
enum class NumberStyle : std::uint8_t {
    plain,                  ///< 1200000.5
    comma,                  ///< 1200000,5
    apostrophe,             ///< 1'200'000.5
    apostrophe_comma,       ///< 1'200'000,5
    blank,                  ///< 1 200 000.5
    blank_comma,            ///< 1 200 000,5
    thousands_comma,        ///< 1,200,000.5
    thousands_point_comma,  ///< 1.200.000,5
};
inline constexpr int number_styles = 8;

/// The styles, as bits, in which a cell is a number, or a bound such as "<0,01". 0: it is none. A cell is in several
/// when they agree ("12") or when nobody can know ("1,500").
std::uint8_t styles_of(std::string_view cell);

/// A cell that is a number in that style, with a point and without signs between thousands.
std::string plain_number(std::string_view cell, NumberStyle style);

/// Brings the numbers of all columns but that of ids to the plain style, with notes. A column is taken for numbers when
/// half of its filled cells are, and its style is the one in which all of those are; where several would do and give
/// other numbers, the columns that leave no choice decide for the table, and without any the column stays as it is
/// ("1,500" is then no number; "1.500" is one and a half).
void accept_number_styles(Table& table, int id_column);

}  // namespace terratet
