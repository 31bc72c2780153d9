// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cells of a CSV row: quoted as RFC 4180 says, numbers with as many digits as they need to be read back exactly.

#include <charconv>
#include <cmath>
#include <string>

#include "tess/property.hpp"

namespace terratet {

inline void append_csv_text(std::string& row, const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
        row += text;
        return;
    }
    row += '"';
    for (const char c : text) {
        row += c;
        if (c == '"') {
            row += '"';
        }
    }
    row += '"';
}

template <class Number>
void append_csv_number(std::string& row, Number value) {
    char digits[32];
    row.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
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
