// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/read_table.hpp"

#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <set>
#include <span>
#include <string_view>

#include "io/base/csv_text.hpp"
#include "io/base/gdal_dataset.hpp"
#include "io/base/library_failure.hpp"
#include "io/base/text_lines.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {

namespace {

std::string without_blanks(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

/// The shortest text that reads back as the same number; "34873" for 34873.0, never "1e+05".
template <typename Number>
std::string shortest(Number value) {
    std::array<char, 40> buffer{};
    const bool whole = std::abs(value) < Number(1e15) && value == std::trunc(value);
    const auto end = whole ? std::to_chars(buffer.data(), buffer.data() + buffer.size(), static_cast<long long>(value))
                           : std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), end.ptr};
}

std::string cell_text(const OGRFeature& feature, int field) {
    if (feature.IsFieldSetAndNotNull(field) == 0) {
        return "";
    }
    const OGRFieldDefn& definition = *feature.GetFieldDefnRef(field);
    if (definition.GetType() == OFTReal) {
        const double value = feature.GetFieldAsDouble(field);
        return definition.GetSubType() == OFSTFloat32 ? shortest(static_cast<float>(value)) : shortest(value);
    }
    return without_blanks(to_utf8(feature.GetFieldAsString(field)));
}

/// The position of a point geometry (or of a multi-point of one); z NaN when it has none.
std::optional<Vec3> point_of(const OGRGeometry* geometry) {
    if (geometry != nullptr && wkbFlatten(geometry->getGeometryType()) == wkbMultiPoint &&
        geometry->toMultiPoint()->getNumGeometries() == 1) {
        geometry = geometry->toMultiPoint()->getGeometryRef(0);
    }
    if (geometry == nullptr || geometry->IsEmpty() || wkbFlatten(geometry->getGeometryType()) != wkbPoint) {
        return std::nullopt;
    }
    const OGRPoint& point = *geometry->toPoint();
    return Vec3{point.getX(), point.getY(), point.Is3D() != 0 ? point.getZ() : missing};
}

bool all_digits(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Empty, or named by the driver for want of a name: field_3 (CSV), Field3 (XLSX).
bool is_unnamed(const std::string& column) {
    if (column.empty()) {
        return true;
    }
    const std::string_view rest = std::string_view(column).substr(std::min<std::size_t>(column.size(), 5));
    return EQUALN(column.c_str(), "field", 5) && all_digits(rest.starts_with('_') ? rest.substr(1) : rest);
}

bool has_no_header(const Table& table) {
    return std::ranges::all_of(table.columns, is_unnamed);
}

Table read_layer(OGRLayer& layer, const Source& source) {
    Table table;
    table.file = source.describe();
    table.crs = crs_of(layer);
    OGRFeatureDefn& definition = *layer.GetLayerDefn();
    for (int field = 0; field < definition.GetFieldCount(); ++field) {
        table.columns.push_back(without_blanks(to_utf8(definition.GetFieldDefn(field)->GetNameRef())));
    }
    table.cells.resize(table.columns.size());
    layer.ResetReading();
    bool any_point = false;
    while (const OGRFeatureUniquePtr feature{layer.GetNextFeature()}) {
        for (std::size_t column = 0; column < table.columns.size(); ++column) {
            table.cells[column].push_back(cell_text(*feature, static_cast<int>(column)));
        }
        table.points.push_back(point_of(feature->GetGeometryRef()));
        any_point = any_point || table.points.back();
        table.lines.push_back(feature->GetFID());
    }
    if (!any_point) {
        table.points.clear();
    }
    return table;
}

/// A stream cannot be read twice.
bool is_stream(const std::string& path) {
    return path.find("/vsistdin/") != std::string::npos;
}

/// The line on which each record of a text file begins, as the CSV driver counts records: blank lines are none, and a
/// record goes on while a quote is open.
std::vector<std::int64_t> record_lines(const std::string& path) {
    std::vector<std::int64_t> starts;
    VSILFILE* file = VSIFOpenL(path.c_str(), "rb");
    if (file == nullptr) {
        return starts;
    }
    std::int64_t line = 1;
    std::int64_t start = 1;
    bool quoted = false;
    bool blank = true;
    char previous = '\0';
    std::vector<char> buffer(1U << 16U);
    while (const std::size_t n = VSIFReadL(buffer.data(), 1, buffer.size(), file)) {
        for (const char c : std::span(buffer).first(n)) {
            const bool second_of_crlf = c == '\n' && previous == '\r';
            previous = c;
            if (c != '\n' && c != '\r') {
                quoted = quoted != (c == '"');
                blank = false;
                continue;
            }
            if (second_of_crlf) {
                continue;
            }
            ++line;
            if (!quoted) {
                if (!blank) {
                    starts.push_back(start);
                }
                start = line;
                blank = true;
            }
        }
    }
    VSIFCloseL(file);
    if (!blank) {
        starts.push_back(start);
    }
    return starts;
}

/// From the driver's record numbers to lines of the file; in a stream, records are counted.
void number_lines(Table& table, const Source& source) {
    const std::string path = source.path.starts_with("CSV:") ? source.path.substr(4) : source.path;
    const std::int64_t header = has_no_header(table) ? 0 : 1;
    const std::vector<std::int64_t> starts = is_stream(path) ? std::vector<std::int64_t>{} : record_lines(path);
    for (std::int64_t& line : table.lines) {
        const std::int64_t record = line + header;  // 1-based
        line = record >= 1 && record <= static_cast<std::int64_t>(starts.size())
                   ? starts[static_cast<std::size_t>(record - 1)]
                   : record;
    }
}

void drop_empty_columns(Table& table) {
    for (std::size_t column = table.columns.size(); column-- > 0;) {
        const bool empty = std::ranges::all_of(table.cells[column], &std::string::empty);
        if (empty && is_unnamed(table.columns[column])) {
            table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(column));
            table.cells.erase(table.cells.begin() + static_cast<std::ptrdiff_t>(column));
        }
    }
}

/// "1,5" can only be a decimal comma; "1,500" may be fifteen hundred.
enum class Comma { none, ambiguous, decimal, other };

Comma comma_in(const std::string& cell) {
    const std::size_t comma = cell.find(',');
    if (comma == std::string::npos) {
        return cell.find('.') != std::string::npos && parse_number(cell) ? Comma::other : Comma::none;
    }
    std::string with_point = cell;
    with_point[comma] = '.';
    if (comma + 1 == cell.size() || !parse_number(with_point)) {
        return Comma::other;
    }
    const std::string_view whole = std::string_view(cell).substr(0, comma);
    const std::string_view rest = std::string_view(cell).substr(comma + 1);
    const bool thousands = all_digits(rest) && rest.size() == 3 && whole.size() <= 4 && !whole.empty() &&
                           all_digits(whole.substr(whole.front() == '-' ? 1 : 0)) && whole != "0" && whole != "-0";
    return thousands ? Comma::ambiguous : Comma::decimal;
}

/// A table with decimal commas has them throughout: one column that proves it settles the ambiguous ones too.
void accept_decimal_commas(Table& table) {
    std::vector<std::size_t> columns;
    bool proven = false;
    const int id = find_optional_column(table, Meaning::id, {});
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        if (static_cast<int>(column) == id) {
            continue;  // ids stay as they are
        }
        std::set<Comma> found;
        for (const std::string& cell : table.cells[column]) {
            found.insert(comma_in(cell));
        }
        const bool commas = found.contains(Comma::decimal) || found.contains(Comma::ambiguous);
        if (commas && !found.contains(Comma::other)) {
            columns.push_back(column);
            proven = proven || found.contains(Comma::decimal);
        }
    }
    if (!proven) {
        return;
    }
    std::string names;
    for (const std::size_t column : columns) {
        names += (names.empty() ? "" : ", ") + table.columns[column];
        for (std::string& cell : table.cells[column]) {
            std::ranges::replace(cell, ',', '.');
        }
    }
    table.notes.push_back(table.file + ": decimal commas read as points in " + names);
}

bool has_driver(GDALDataset& dataset, std::initializer_list<const char*> names) {
    const char* driver = dataset.GetDriver() == nullptr ? "" : dataset.GetDriver()->GetDescription();
    return std::ranges::any_of(names, [&](const char* name) { return EQUAL(driver, name); });
}

/// Records are counted from 1: what a statement gives, and what drivers number from 0.
void number_records(Table& table, GDALDataset& dataset, const Source& source) {
    if (!source.sql.empty()) {
        std::iota(table.lines.begin(), table.lines.end(), std::int64_t{1});
    } else if (has_driver(dataset, {"ESRI Shapefile", "FlatGeobuf", "GeoJSON", "GeoJSONSeq"})) {
        std::ranges::for_each(table.lines, [](std::int64_t& line) { ++line; });
    }
}

/// Is the first row of a table without header one after all? GDAL takes a row with a number in it for data.
bool first_row_is_header(const Table& table) {
    Table titled;
    for (const auto& column : table.cells) {
        titled.columns.push_back(column.empty() ? "" : column.front());
    }
    std::set<int> found;
    for (const Meaning meaning : {Meaning::id, Meaning::x, Meaning::y, Meaning::z, Meaning::from, Meaning::to,
                                  Meaning::depth, Meaning::azimuth, Meaning::dip}) {
        found.insert(find_optional_column(titled, meaning, {}));
    }
    found.erase(-1);
    return found.size() >= 2;
}

/// Texts as they were before a program, ours or another, kept them from being formulas.
void take_formula_marks(Table& table) {
    for (std::string& column : table.columns) {
        column = without_formula_mark(std::move(column));
    }
    for (auto& column : table.cells) {
        for (std::string& cell : column) {
            cell = cell.starts_with('\'') ? without_formula_mark(std::move(cell)) : std::move(cell);
        }
    }
}

bool names_option(const Source& source, const std::string& key) {
    return std::ranges::any_of(source.open_options,
                               [&](const std::string& option) { return option.starts_with(key + "="); });
}

Table read_once(const Source& source, bool& csv) {
    GdalScope scope(source.path);
    const Dataset dataset = open_vector(source);
    csv = has_driver(*dataset, {"CSV"});
    ResultSet result_set;
    OGRLayer& layer = open_layer(*dataset, source, scope, result_set);
    scope.clear();
    Table table = read_layer(layer, source);
    if (scope.failed()) {  // what came before would pass for the whole
        throw InputError(
            fmt::format("{}: reading failed after {} rows ({})", table.file, table.rows(), scope.failure()));
    }
    if (csv) {
        take_formula_marks(table);
    }
    number_records(table, *dataset, source);
    if (table.rows() == 0) {
        throw InputError(table.file + ": has no row" +
                         (source.where.empty() ? " below its header" : " that meets where=" + source.where));
    }
    return table;
}

Table read_titled(const Source& source) {
    bool csv = false;
    Table table = read_once(source, csv);
    const bool untitled = csv && has_no_header(table) && !names_option(source, "HEADERS") && !is_stream(source.path);
    if (untitled && first_row_is_header(table)) {
        Source titled = source;
        titled.open_options.emplace_back("HEADERS=YES");
        table = read_once(titled, csv);
    }
    if (csv && source.sql.empty()) {
        number_lines(table, source);
    }
    drop_empty_columns(table);
    if (csv) {
        accept_decimal_commas(table);
    }
    return table;
}

}  // namespace

Table read_table(const Source& source) {
    return naming_file(source.describe(), [&] { return read_titled(source); });
}

}  // namespace terratet
