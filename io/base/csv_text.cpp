// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/csv_text.hpp"

#include <algorithm>
#include <array>

#include "io/base/parse_number.hpp"

namespace terratet {
namespace {

constexpr char mark = '\'';

/// What spreadsheets take the beginning of a formula from; the last four are fullwidth forms of the first.
bool begins_formula(std::string_view text) {
    constexpr std::array<std::string_view, 11> beginnings{"=", "+", "-", "@", "\t", "\r", "\n", "＝", "＋", "－", "＠"};
    return std::any_of(beginnings.begin(), beginnings.end(), [&](std::string_view b) { return text.starts_with(b); });
}

/// Is it a formula, or already marked as none?
bool needs_mark(std::string_view text) {
    const std::size_t first = std::min(text.find_first_not_of(mark), text.size());
    const std::string_view rest = text.substr(first);
    return rest.size() > 1 && begins_formula(rest) && !(first == 0 && parse_number(text));
}

}  // namespace

void append_csv_text(std::string& row, std::string_view text) {
    const bool marked = needs_mark(text);
    if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
        row += marked ? std::string(1, mark) : "";
        row += text;
        return;
    }
    row += '"';
    row += marked ? std::string(1, mark) : "";
    for (const char c : text) {
        row += c;
        if (c == '"') {
            row += '"';
        }
    }
    row += '"';
}

std::string_view without_formula_mark(std::string_view text) {
    const bool marked = text.starts_with(mark) && needs_mark(text);
    return marked ? text.substr(1) : text;
}

}  // namespace terratet
