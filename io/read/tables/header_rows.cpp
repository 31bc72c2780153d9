// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/header_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "io/base/lower_case.hpp"
#include "io/base/parse_number.hpp"
#include "io/read/tables/columns.hpp"

namespace terratet {
namespace {

bool holds_number(const std::vector<std::string>& cells) {
    return std::ranges::any_of(cells, [](const std::string& cell) { return parse_number(cell).has_value(); });
}

std::vector<std::string> row_of(const Table& table, std::size_t row) {
    std::vector<std::string> cells;
    for (const TextColumn& column : table.cells) {
        cells.emplace_back(column[row]);
    }
    return cells;
}

void drop_first_rows(Table& table, std::size_t count) {
    for (TextColumn& column : table.cells) {
        TextColumn rest;
        for (std::size_t row = count; row < column.size(); ++row) {
            rest.push_back(column[row]);
        }
        column = std::move(rest);
    }
    table.lines.erase(table.lines.begin(), table.lines.begin() + static_cast<std::ptrdiff_t>(count));
}

std::string_view without_brackets(std::string_view cell) {
    const bool bracketed =
        cell.size() > 2 && ((cell.front() == '[' && cell.back() == ']') || (cell.front() == '(' && cell.back() == ')'));
    return bracketed ? cell.substr(1, cell.size() - 2) : cell;
}

bool is_unit(std::string_view cell) {
    static constexpr std::array<std::string_view, 34> units{
        "m",    "ft",   "feet", "metre", "metres", "meter", "meters", "km",  "cm",    "mm",  "usft",   "in",
        "masl", "mbgl", "mrl",  "ppm",   "ppb",    "ppt",   "gpt",    "pct", "wt%",   "deg", "degree", "degrees",
        "dd",   "°",    "%",    "mpa",   "kpa",    "ohmm",  "ohm.m",  "api", "us/ft", "-"};
    const std::string text = lower_case(without_brackets(cell));
    const bool height = (text.starts_with("m ") || text.starts_with("ft ")) && text.size() <= 12;  // m AHD, m NHN
    const bool ratio = text.size() <= 8 && text.find_first_of("/%") != std::string::npos &&
                       text.find_first_of("0123456789", 0) != 0 && text != "n/a";
    return height || ratio || std::ranges::find(units, text) != units.end() || without_brackets(cell) != cell;
}

}  // namespace

bool names_columns(const std::vector<std::string>& names) {
    Table titled;
    titled.columns = names;
    std::set<int> found;
    for (const Meaning meaning : {Meaning::id, Meaning::x, Meaning::y, Meaning::z, Meaning::from, Meaning::to,
                                  Meaning::depth, Meaning::azimuth, Meaning::dip}) {
        found.insert(find_optional_column(titled, meaning, {}));
    }
    found.erase(-1);
    return found.size() >= 2;
}

std::size_t header_record(std::span<const std::vector<std::string>> records) {
    for (std::size_t i = 0; i < std::min(records.size(), most_title_rows); ++i) {
        if (names_columns(records[i]) && (i == 0 || !holds_number(records[i]))) {
            return i;
        }
    }
    return 0;
}

void promote_header(Table& table) {
    if (!table.points.empty() || names_columns(table.columns)) {
        return;
    }
    for (std::size_t row = 0; row < std::min(table.rows(), most_title_rows); ++row) {
        std::vector<std::string> names = row_of(table, row);
        if (names_columns(names) && !holds_number(names)) {
            table.notes.push_back(fmt::format("{}: the header is found on line {}; what stands above is passed over",
                                              table.file, table.lines[row]));
            table.columns = std::move(names);
            drop_first_rows(table, row + 1);
            return;
        }
    }
}

void take_units_row(Table& table) {
    if (table.rows() < 2 || !table.points.empty() || !table.stated.units.empty() || !names_columns(table.columns)) {
        return;
    }
    std::vector<std::string> cells = row_of(table, 0);
    const bool units =
        std::ranges::all_of(cells, [](const std::string& cell) { return cell.empty() || is_unit(cell); }) &&
        std::ranges::any_of(cells, [](const std::string& cell) { return !cell.empty() && cell != "-"; });
    if (!units) {
        return;
    }
    table.notes.push_back(
        fmt::format("{}: line {} holds the units of the columns and is no record", table.file, table.lines.front()));
    for (std::string& cell : cells) {
        cell = cell == "-" ? "" : std::string(without_brackets(cell));
    }
    table.stated.units = std::move(cells);
    drop_first_rows(table, 1);
}

}  // namespace terratet
