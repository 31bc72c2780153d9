// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/read_table.hpp"

#include <fmt/format.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <string_view>

#include "io/base/csv_text.hpp"
#include "io/base/gdal_dataset.hpp"
#include "io/base/library_failure.hpp"
#include "io/base/text_lines.hpp"
#include "io/base/well_format.hpp"
#include "io/read/tables/csv_file.hpp"
#include "io/read/tables/header_rows.hpp"
#include "io/read/tables/number_style.hpp"
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

Table read_layer(OGRLayer& layer, const Source& source, bool csv) {
    Table table;
    table.file = source.describe();
    table.crs = crs_of(layer);
    OGRFeatureDefn& definition = *layer.GetLayerDefn();
    for (int field = 0; field < definition.GetFieldCount(); ++field) {
        const std::string name = without_blanks(to_utf8(definition.GetFieldDefn(field)->GetNameRef()));
        table.columns.emplace_back(csv ? without_formula_mark(name) : name);
    }
    table.cells.resize(table.columns.size());
    layer.ResetReading();
    bool any_point = false;
    std::vector<std::string> cells(table.columns.size());
    while (const OGRFeatureUniquePtr feature{layer.GetNextFeature()}) {
        for (std::size_t column = 0; column < cells.size(); ++column) {
            cells[column] = cell_text(*feature, static_cast<int>(column));
        }
        const bool blank = std::ranges::all_of(cells, [](const std::string& text) { return text.empty(); });
        if (blank && feature->GetGeometryRef() == nullptr) {
            continue;  // as a sheet has them
        }
        for (std::size_t column = 0; column < cells.size(); ++column) {
            table.cells[column].push_back(csv ? without_formula_mark(cells[column]) : cells[column]);
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

/// Last first.
std::vector<std::size_t> empty_columns(const Table& table) {
    std::vector<std::size_t> empty;
    for (std::size_t column = table.columns.size(); column-- > 0;) {
        if (is_unnamed(table.columns[column]) &&
            std::ranges::all_of(table.cells[column], [](std::string_view cell) { return cell.empty(); })) {
            empty.push_back(column);
        }
    }
    return empty;
}

void drop_columns(Table& table, const std::vector<std::size_t>& last_first) {
    for (const std::size_t column : last_first) {
        table.columns.erase(table.columns.begin() + static_cast<std::ptrdiff_t>(column));
        table.cells.erase(table.cells.begin() + static_cast<std::ptrdiff_t>(column));
        if (!table.stated.units.empty()) {
            table.stated.units.erase(table.stated.units.begin() + static_cast<std::ptrdiff_t>(column));
        }
    }
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

bool first_row_is_header(const Table& table) {
    std::vector<std::string> names;
    for (const TextColumn& column : table.cells) {
        names.emplace_back(column.empty() ? "" : column.front());
    }
    return names_columns(names);
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
    Table table = read_layer(layer, source, csv);
    if (scope.failed()) {  // what came before would pass for the whole
        throw InputError(
            fmt::format("{}: reading failed after {} rows ({})", table.file, table.rows(), scope.failure()));
    }
    if (const std::string note = other_layers(*dataset, layer, source); !note.empty()) {
        table.notes.push_back(table.file + ": " + note);
    }
    number_records(table, *dataset, source);
    return table;
}

/// A well file is a table of nonsense to GDAL.
void refuse_wells(const Source& source) {
    static const std::map<WellFormat, const char*> names{{WellFormat::las, "a LAS well log"},
                                                         {WellFormat::ags, "an AGS file"},
                                                         {WellFormat::gef, "a GEF file"},
                                                         {WellFormat::gocad, "a GOCAD well"},
                                                         {WellFormat::rms, "an RMS well"}};
    const auto found = source.layer.empty() && source.sql.empty() ? names.find(well_format(source.path)) : names.end();
    if (found != names.end()) {
        throw InputError(fmt::format("{}: is {}, not a table; name it with `boreholes` or `logs`", source.describe(),
                                     found->second));
    }
}

/// By GDAL: what is no text, and text with a filter, a statement or geometries.
Table read_by_gdal(const Source& source) {
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
    return table;
}

/// The value of an open option in upper case; empty: not given.
std::string option(const Source& source, const std::string& key) {
    for (const std::string& text : source.open_options) {
        if (EQUALN(text.c_str(), (key + "=").c_str(), key.size() + 1)) {
            return CPLString(text.substr(key.size() + 1)).toupper();
        }
    }
    return {};
}

bool is_file(const std::string& path) {
    VSIStatBufL status;
    return VSIStatExL(path.c_str(), &status, VSI_STAT_EXISTS_FLAG) == 0;
}

/// What the options say of a text; nothing when they are GDAL's to understand.
std::optional<CsvOptions> csv_options(const Source& source) {
    CsvOptions options;
    const std::string extension = CPLString(CPLGetExtension(source.path.c_str())).tolower();
    options.separator = extension == "tsv" ? '\t' : extension == "psv" ? '|' : 0;
    for (const auto& [name, sign] :
         {std::pair{"COMMA", ','}, {"SEMICOLON", ';'}, {"TAB", '\t'}, {"SPACE", ' '}, {"PIPE", '|'}}) {
        options.separator = option(source, "SEPARATOR") == name ? sign : options.separator;
    }
    const std::string header = option(source, "HEADERS");
    if (header == "YES" || header == "NO") {
        options.header = header == "YES";
    }
    const auto known =
        static_cast<std::size_t>(!option(source, "SEPARATOR").empty()) + static_cast<std::size_t>(!header.empty());
    const bool types =
        extension == "csv" && !is_stream(source.path) && is_file(CPLResetExtension(source.path.c_str(), "csvt"));
    return known == source.open_options.size() && source.where.empty() && source.sql.empty() && !types
               ? std::optional(options)
               : std::nullopt;
}

bool holds_geometry(const Table& table) {
    return std::ranges::any_of(table.columns, [](const std::string& column) {
        return EQUAL(column.c_str(), "WKT") || EQUALN(column.c_str(), "_WKT", 4) || EQUAL(column.c_str(), "the_geom");
    });
}

/// How to read a source as text; nothing where GDAL has to.
std::optional<CsvOptions> text_options(const Source& source) {
    refuse_wells(source);
    const auto options = csv_options(source);
    const bool own_layer = source.layer.empty() || source.layer == CPLGetBasename(source.path.c_str());
    return options && own_layer && is_text_table(source) ? options : std::nullopt;
}

[[noreturn]] void refuse_empty(const Source& source) {
    throw InputError(source.describe() + ": has no row" +
                     (source.where.empty() ? " below its header" : " that meets where=" + source.where));
}

}  // namespace

struct TableReader::Impl {
    Source source;
    std::optional<CsvFile> text{};
    std::vector<std::size_t> dropped{};
    std::vector<std::string> columns{};  ///< as the first rows say
    std::vector<std::string> units{};
    bool begun = false;

    std::optional<Table> first(std::size_t most) {
        Table table;
        if (const auto options = text_options(source)) {
            text.emplace(source.path.starts_with("CSV:") ? source.path.substr(4) : source.path, *options);
            table = text->next(most);
            table.file = source.describe();
        }
        if (!text || holds_geometry(table)) {
            text.reset();
            table = read_by_gdal(source);
        }
        if (table.rows() == 0) {
            refuse_empty(source);
        }
        promote_header(table);
        take_units_row(table);
        if (table.rows() == 0) {
            throw InputError(table.file + ": has no row below its header");
        }
        dropped = empty_columns(table);
        columns = table.columns;
        units = table.stated.units;
        return prepared(std::move(table));
    }

    std::optional<Table> further(std::size_t most) {
        if (!text) {
            return std::nullopt;
        }
        Table table = text->next(most);
        table.file = source.describe();
        table.columns = columns;
        table.stated.units = units;
        return table.rows() > 0 ? std::optional(prepared(std::move(table))) : std::nullopt;
    }

    Table prepared(Table table) const {
        drop_columns(table, dropped);
        accept_number_styles(table, find_optional_column(table, Meaning::id, {}));
        return table;
    }
};

TableReader::TableReader(Source source) : impl_(std::make_unique<Impl>(Impl{std::move(source)})) {}
TableReader::~TableReader() = default;
TableReader::TableReader(TableReader&&) noexcept = default;

std::optional<Table> TableReader::next(std::size_t most) {
    return naming_file(impl_->source.describe(),
                       [&] { return std::exchange(impl_->begun, true) ? impl_->further(most) : impl_->first(most); });
}

Table read_table(const Source& source) {
    return *TableReader(source).next(std::numeric_limits<std::size_t>::max());
}

}  // namespace terratet
