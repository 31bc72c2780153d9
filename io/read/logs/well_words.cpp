// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/logs/well_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "io/base/lower_case.hpp"
#include "io/base/parse_number.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/tables/degrees.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

constexpr std::size_t most_columns = 10'000;

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Words and strokes that stand for no value.
bool is_no_value(std::string_view text) {
    const bool strokes = text.find_first_not_of("-*.?#") == std::string_view::npos;
    if (strokes) {
        return true;
    }
    static constexpr std::array<std::string_view, 19> words{
        "nan", "-nan", "null",   "(null)",  "none",    "err",    "error", "na",   "n/a",    "#n/a",
        "nil", "ind",  "1.#ind", "-1.#ind", "1.#qnan", "1.#inf", "inf",   "-inf", "-1.#inf"};
    const std::string lower = lower_case(std::string(text));
    // "-1.#IND00" and its like have as many digits as the program liked
    const std::string stem = lower.substr(0, lower.find_last_not_of('0') + 1);
    return std::ranges::find(words, lower) != words.end() || std::ranges::find(words, stem) != words.end();
}

Crs parsed(const std::string& code) {
    try {
        return parse_crs(code);
    } catch (const Error&) {
        return {};
    }
}

}  // namespace

double metres_in_log_unit(std::string_view unit) {
    std::string name = lower_case(std::string(trimmed(unit)));
    std::erase_if(name, [](char c) { return c == '[' || c == ']' || c == '(' || c == ')' || c == ' '; });
    static const std::map<std::string, double> metres{{"m", 1},
                                                      {"meter", 1},
                                                      {"meters", 1},
                                                      {"metre", 1},
                                                      {"metres", 1},
                                                      {"mts", 1},
                                                      {"mtr", 1},
                                                      {"m.", 1},
                                                      {"\xD0\xBC", 1},
                                                      {"\xD0\x9C", 1},
                                                      {"mmd", 1},
                                                      {"mbgl", 1},
                                                      {"f", 0.3048},
                                                      {"ft", 0.3048},
                                                      {"feet", 0.3048},
                                                      {"foot", 0.3048},
                                                      {"ft.", 0.3048},
                                                      {"'", 0.3048},
                                                      {".1in", 0.00254},
                                                      {"0.1in", 0.00254},
                                                      {"1/10in", 0.00254},
                                                      {"in", 0.0254},
                                                      {"inch", 0.0254},
                                                      {"cm", 0.01},
                                                      {"mm", 0.001},
                                                      {"km", 1000},
                                                      {"ftus", 1200.0 / 3937},
                                                      {"usft", 1200.0 / 3937}};
    const auto found = metres.find(name);
    return found == metres.end() ? 0 : found->second;
}

std::string bare(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
            result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        }
    }
    return result;
}

std::optional<double> degrees(std::string_view text) {
    if (const auto number = parse_number(text)) {
        return number;
    }
    const auto found = parse_degrees(text);
    return found ? std::optional(found->value) : std::nullopt;
}

Crs crs_of_datum(const std::string& datum) {
    static const std::map<std::string, const char*> codes{
        {"WGS84", "EPSG:4326"}, {"WGS1984", "EPSG:4326"},   {"NAD83", "EPSG:4269"},    {"NAD1983", "EPSG:4269"},
        {"NAD27", "EPSG:4267"}, {"NAD1927", "EPSG:4267"},   {"ETRS89", "EPSG:4258"},   {"ETRF89", "EPSG:4258"},
        {"ED50", "EPSG:4230"},  {"GDA94", "EPSG:4283"},     {"GDA2020", "EPSG:7844"},  {"AGD66", "EPSG:4202"},
        {"AGD84", "EPSG:4203"}, {"NZGD2000", "EPSG:4167"},  {"OSGB36", "EPSG:4277"},   {"SIRGAS2000", "EPSG:4674"},
        {"WGS72", "EPSG:4322"}, {"NAD83CSRS", "EPSG:4617"}, {"CGCS2000", "EPSG:4490"}, {"PULKOVO1942", "EPSG:4284"}};
    const auto found = codes.find(bare(datum));
    return found == codes.end() ? Crs{} : parsed(found->second);
}

Crs crs_by_name(const std::string& name) {
    static const std::map<std::string, const char*> codes{{"OSGB", "EPSG:27700"},
                                                          {"OSGB36", "EPSG:27700"},
                                                          {"OSGR", "EPSG:27700"},
                                                          {"BNG", "EPSG:27700"},
                                                          {"NGR", "EPSG:27700"},
                                                          {"BRITISHNATIONALGRID", "EPSG:27700"},
                                                          {"NATIONALGRID", "EPSG:27700"},
                                                          {"OSNG", "EPSG:27700"},
                                                          {"ITM", "EPSG:2157"},
                                                          {"IRISHTRANSVERSEMERCATOR", "EPSG:2157"},
                                                          {"ING", "EPSG:29903"},
                                                          {"IG", "EPSG:29903"},
                                                          {"IRISHGRID", "EPSG:29903"},
                                                          {"IRISHNATIONALGRID", "EPSG:29903"},
                                                          {"HK80", "EPSG:2326"},
                                                          {"HK1980", "EPSG:2326"},
                                                          {"HONGKONG1980GRID", "EPSG:2326"},
                                                          {"HK1980GRID", "EPSG:2326"},
                                                          {"RD", "EPSG:28992"},
                                                          {"RDNEW", "EPSG:28992"},
                                                          {"RIJKSDRIEHOEKSMETING", "EPSG:28992"},
                                                          {"NZTM", "EPSG:2193"},
                                                          {"NZTM2000", "EPSG:2193"},
                                                          {"SVY21", "EPSG:3414"}};
    const std::string key = bare(name);
    if (key.empty()) {
        return {};
    }
    if (const auto found = codes.find(key); found != codes.end()) {
        return parsed(found->second);
    }
    if (const Crs datum = crs_of_datum(name); !datum.empty()) {
        return datum;
    }
    const bool spelt = name.find(':') != std::string::npos || name.find(" / ") != std::string::npos;
    return spelt ? parsed(name) : Crs{};
}

std::string log_cell(std::string_view text) {
    text = trimmed(text);
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front()) {
        text = trimmed(text.substr(1, text.size() - 2));
    }
    if (text.empty()) {
        return {};
    }
    const char last = text.back();
    const bool plain = is_digit(last) && text.find_first_not_of("0123456789.-") == std::string_view::npos;
    if (plain) {
        return std::string(text);
    }
    if (is_no_value(text)) {
        return {};
    }
    std::string cell(text);
    const bool digits =
        cell.find_first_not_of("0123456789.,+-eEdD") == std::string::npos && (is_digit(last) || last == '.');
    if (digits) {
        if (std::ranges::count(cell, ',') == 1 && cell.find('.') == std::string::npos) {
            std::ranges::replace(cell, ',', '.');
        }
        std::ranges::replace_if(
            cell, [](char c) { return c == 'd' || c == 'D'; }, 'E');
        return cell;
    }
    return to_utf8(cell);
}

int LogTable::add_column(std::string name, std::string unit) {
    if (table_.columns.size() == most_columns) {
        throw InputError(fmt::format("{}: more than {} columns", table_.file, most_columns));
    }
    table_.columns.push_back(std::move(name));
    table_.stated.units.push_back(std::move(unit));
    table_.cells.emplace_back();
    for (std::size_t row = 0; row < table_.rows(); ++row) {
        table_.cells.back().push_back({});
    }
    return static_cast<int>(table_.columns.size() - 1);
}

void LogTable::add_row(const std::vector<std::string>& cells, std::int64_t line, std::uint64_t bytes) {
    for (std::size_t column = 0; column < columns(); ++column) {
        table_.cells[column].push_back(column < cells.size() ? std::string_view(cells[column]) : std::string_view());
    }
    end_row(line, bytes);
}

void LogTable::end_row(std::int64_t line, std::uint64_t bytes) {
    table_.lines.push_back(line);
    if (columns() * table_.rows() > 2 * bytes + 1'000'000) {
        throw InputError(fmt::format("{}, line {}: most of its rows lack most of their {} columns; is it whole?",
                                     table_.file, line, columns()));
    }
}

Table LogTable::finish() {
    std::map<std::string, int> count;
    std::set<std::string> used;
    for (std::string& name : table_.columns) {
        name = name.empty() ? "UNKNOWN" : name;
        const std::string wanted = name;
        int& n = count[lower_case(wanted)];
        while (!used.insert(lower_case(name)).second) {
            n = std::max(n, 1) + 1;
            name = fmt::format("{}_{}", wanted, n);
        }
    }
    return std::move(table_);
}

Table collar_table(const std::string& file) {
    Table table;
    table.file = file;
    table.columns = {"HOLE", "X", "Y", "Z", "LENGTH"};
    table.cells.resize(table.columns.size());
    table.stated.meanings = {{Meaning::id, 0}, {Meaning::x, 1}, {Meaning::y, 2}, {Meaning::z, 3}, {Meaning::length, 4}};
    return table;
}

void add_collar(Table& collars, const std::string& hole, const std::string& x, const std::string& y,
                const std::string& z, const std::string& length, std::int64_t line) {
    const std::array<const std::string*, 5> cells{&hole, &x, &y, &z, &length};
    for (std::size_t column = 0; column < cells.size(); ++column) {
        collars.cells[column].push_back(*cells[column]);
    }
    collars.lines.push_back(line);
}

}  // namespace terratet
