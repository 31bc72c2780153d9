// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/qualifiers.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "io/base/lower_case.hpp"

namespace terratet {
namespace {

constexpr std::array<std::string_view, 9> name_words{"qualifier", "qual",   "flag",   "sign", "prefix",
                                                     "operator",  "detect", "censor", "q"};

bool is_named(const Table& table, std::size_t column, const ColumnNames& columns) {
    return std::ranges::any_of(columns, [&](const auto& named) {
        return named.first == to_string(Meaning::qualifier) &&
               lower_case(named.second) == lower_case(table.columns[column]);
    });
}

/// Nothing but signs of comparison, and one of them that bounds.
bool holds_signs(const TextColumn& column) {
    bool bounds = false;
    for (const std::string_view cell : column) {
        if (cell.empty() || cell == "=") {
            continue;
        }
        if (bound_sign(cell) != cell.size()) {
            return false;
        }
        bounds = true;
    }
    return bounds;
}

bool holds_numbers(const TextColumn& column) {
    std::size_t filled = 0;
    std::size_t numbers = 0;
    for (const std::string_view cell : column) {
        filled += cell.empty() ? 0 : 1;
        numbers += parse_number(cell) ? 1 : 0;
    }
    return numbers > 0 && 2 * numbers >= filled;
}

/// "as" of AS_QUAL and of Q_AS; empty when the name says nothing but that it qualifies.
std::string qualified_name(const std::string& header) {
    std::string name = normal_header(header);
    for (const std::string_view word : name_words) {
        if (name.size() > word.size() && name.ends_with(word)) {
            return name.substr(0, name.size() - word.size());
        }
        if (name.size() > word.size() && word != "q" && name.starts_with(word)) {
            return name.substr(word.size());
        }
    }
    const bool short_ahead = lower_case(header).starts_with("q_") || lower_case(header).starts_with("q ");
    return short_ahead ? name.substr(1) : "";
}

int qualified_column(const Table& table, std::size_t qualifier) {
    const int columns = static_cast<int>(table.columns.size());
    const auto can_be = [&](int column) {
        return column >= 0 && column < columns && column != static_cast<int>(qualifier) &&
               holds_numbers(table.cells[static_cast<std::size_t>(column)]);
    };
    if (const std::string name = qualified_name(table.columns[qualifier]); !name.empty()) {
        int best = -1;
        std::size_t shortest = std::string::npos;
        for (int column = 0; column < columns; ++column) {
            const std::string other = normal_header(table.columns[static_cast<std::size_t>(column)]);
            if (other.starts_with(name) && other.size() < shortest && can_be(column)) {
                best = column;
                shortest = other.size();
            }
        }
        if (best >= 0) {
            return best;
        }
    }
    const int here = static_cast<int>(qualifier);
    return can_be(here + 1) ? here + 1 : can_be(here - 1) ? here - 1 : -1;
}

}  // namespace

std::vector<int> qualifiers(const Table& table, const ColumnNames& columns) {
    std::vector<int> result(table.columns.size(), -1);
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        if (is_named(table, column, columns) || holds_signs(table.cells[column])) {
            if (const int qualified = qualified_column(table, column); qualified >= 0) {
                result[static_cast<std::size_t>(qualified)] = static_cast<int>(column);
            }
        }
    }
    return result;
}

Censoring qualifier_of(std::string_view cell) {
    if (const std::size_t sign = bound_sign(cell); sign > 0) {
        return is_upper_bound(cell) ? Censoring::below : Censoring::above;
    }
    static constexpr std::array<std::string_view, 11> below{"lt",  "nd",  "n.d.", "n/d",  "u", "bdl",
                                                            "bql", "bld", "lod",  "<lod", "le"};
    const std::string word = lower_case(cell);
    return std::ranges::find(below, word) != below.end() ? Censoring::below
           : word == "gt" || word == "ge"                ? Censoring::above
                                                         : Censoring::none;
}

}  // namespace terratet
