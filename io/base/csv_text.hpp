// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cells of a CSV row: quoted as RFC 4180 says, numbers with as many digits as they need to be read back exactly.

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>

#include "tess/property.hpp"

namespace terratet {

/// Text that a spreadsheet would take for a formula (it begins with =, +, -, @, a tab or a line end, and is no number)
/// gets an apostrophe before it, and so does text that begins with apostrophes and then such a sign: the reader takes
/// one away, so that every text survives.
void append_csv_text(std::string& row, std::string_view text);

/// The text as it was before append_csv_text.
std::string_view without_formula_mark(std::string_view text);

/// The fewest digits that read back as the same number; coordinates without an exponent, as people write them: 500000.
template <class Number>
void append_csv_number(std::string& row, Number value) {
    char digits[32];
    char* const end = digits + sizeof digits;
    if constexpr (std::is_floating_point_v<Number>) {
        if (std::abs(value) >= 1e5F && std::abs(value) < 1e15F) {
            row.append(digits, std::to_chars(digits, end, value, std::chars_format::fixed).ptr);
            return;
        }
    }
    row.append(digits, std::to_chars(digits, end, value).ptr);
}

/// Nothing for a missing value; a category by its name.
inline void append_csv_value(std::string& row, const Property& property, double value) {
    if (std::isnan(value)) {
        return;
    }
    if (property.kind == Kind::categorical && value >= 0 && value < static_cast<double>(property.classes.size())) {
        append_csv_text(row, property.classes[static_cast<std::size_t>(value)]);
    } else {
        append_csv_number(row, value);
    }
}

}  // namespace terratet
