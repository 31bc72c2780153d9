// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/read_positions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "io/read/tables/area_of_use.hpp"
#include "io/read/tables/degrees.hpp"
#include "io/read/tables/header_units.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {

namespace {

constexpr Vec3 nowhere{missing, missing, missing};

struct PositionColumns {
    int x = -1;
    int y = -1;
    int z = -1;
    [[nodiscard]] bool plane() const { return x >= 0 && y >= 0; }
};

std::string_view cell(const Table& table, int column, std::size_t row) {
    return table.cells[static_cast<std::size_t>(column)][row];
}

const std::string& header(const Table& table, int column) {
    return table.columns[static_cast<std::size_t>(column)];
}

bool names_degrees(const Table& table, const PositionColumns& columns) {
    return columns.plane() && (normal_header(header(table, columns.x)).starts_with("lon") ||
                               normal_header(header(table, columns.y)).starts_with("lat"));
}

bool names_column(const ColumnNames& columns, Meaning meaning) {
    return std::ranges::any_of(columns, [&](const auto& entry) { return entry.first == to_string(meaning); });
}

/// Do columns and geometry place some row differently, beyond what rounding in a text explains?
bool differ(const Table& table, const PositionColumns& columns) {
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const auto x = parse_number(cell(table, columns.x, row));
        const auto y = parse_number(cell(table, columns.y, row));
        if (!x || !y || !table.points[row]) {
            continue;
        }
        const double tolerance = 1e-6 * (std::abs(*x) + std::abs(*y)) + 1e-9;
        if (std::abs(*x - table.points[row]->x) > tolerance || std::abs(*y - table.points[row]->y) > tolerance) {
            return true;
        }
    }
    return false;
}

/// The columns to use; x and y are −1 when the geometry counts.
PositionColumns choose_columns(const Table& table, const ColumnNames& names, Diagnostics& diagnostics) {
    PositionColumns columns{find_column(table, Meaning::x, names), find_column(table, Meaning::y, names),
                            find_column(table, Meaning::z, names)};
    const bool geometry = !table.points.empty();
    if (!columns.plane() && !geometry) {
        const Meaning lacking = columns.x < 0 ? Meaning::x : Meaning::y;
        throw InputError(
            fmt::format("{}: no column for {} and no point geometry; columns: {}; name one with "
                        "`columns` {}=NAME",
                        table.file, to_string(lacking), fmt::join(table.columns, ", "), to_string(lacking)));
    }
    const bool asked = names_column(names, Meaning::x) || names_column(names, Meaning::y);
    if (columns.plane() && geometry && !table.crs.empty() && !asked && differ(table, columns)) {
        diagnostics.note(
            fmt::format("{}: columns {} and {} differ from the points of the layer, which are used "
                        "(`columns` x={} y={} takes the columns)",
                        table.file, header(table, columns.x), header(table, columns.y), header(table, columns.x),
                        header(table, columns.y)));
        columns.x = columns.y = -1;
    }
    const bool heights = columns.z >= 0 || std::ranges::any_of(table.points, [](const auto& point) {
                             return point && !std::isnan(point->z);
                         });
    if (!heights) {
        throw InputError(
            fmt::format("{}: no column for the height (Z, ELEV, RL, …) and no height in a geometry; columns: "
                        "{}; name one with `columns` z=NAME",
                        table.file, fmt::join(table.columns, ", ")));
    }
    return columns;
}

/// Headers of heights that surely count upwards.
bool names_height(const std::string& column) {
    const std::string name = normal_header(column);
    return std::ranges::any_of(std::array{"elev", "height", "altit", "masl", "amsl", "hoehe", "ansatz", "cota", "rl"},
                               [&](const char* word) { return name.starts_with(word); });
}

/// 1, or −1 where the heights of a table count downwards; noted.
double height_sign(const Table& table, const PositionColumns& columns, ZPositive z_positive, Diagnostics& diagnostics) {
    const std::string name = columns.z < 0 ? "" : header(table, columns.z);
    if (z_positive == ZPositive::automatic && names_depth(name)) {
        diagnostics.note(
            fmt::format("{}: column {} is read as positive downwards, by its name (`z_positive` up says otherwise)",
                        table.file, name));
        return -1;
    }
    if (z_positive == ZPositive::down && names_height(name)) {
        diagnostics.note(fmt::format(
            "{}: column {} is read as positive upwards, by its name, whatever `z_positive` says", table.file, name));
        return 1;
    }
    return z_positive == ZPositive::down ? -1 : 1;
}

/// Heights of the column in units of the CRS's: other than 1 where its header states another unit (noted). Where those
/// beside it state the same, or the CRS is local, all three are in one unit, whatever it is.
double height_factor(const Table& table, const PositionColumns& columns, const Crs& crs, Diagnostics& diagnostics) {
    const auto stated = crs.local ? std::nullopt : stated_length_unit(table, columns.z);
    const auto beside = stated_length_unit(table, columns.x);
    if (!stated || std::abs(stated->metres / crs.metres_per_height - 1) < 1e-5 ||
        (beside && beside->metres == stated->metres)) {
        return 1;
    }
    diagnostics.note(fmt::format("{}: heights are taken in {}, as column {} states", table.file, stated->text,
                                 header(table, columns.z)));
    return stated->metres / crs.metres_per_height;
}

/// The codes in a column of coordinates that are none, by themselves or since the user says so.
class NoCoordinates {
  public:
    /// \param values  the column's numbers
    NoCoordinates(const Table& table, int column, const char* meaning, std::span<const double> values,
                  const std::vector<NullValue>& nulls)
        : nulls_(nulls), names_{meaning} {
        if (column < 0) {
            return;
        }
        names_.push_back(header(table, column));
        for (const NullCode& found : null_codes(values)) {
            if (found.far) {
                codes_.push_back(found.code);
            }
        }
    }

    /// Can any number stand for none?
    [[nodiscard]] bool empty() const { return codes_.empty() && nulls_.empty(); }

    /// A zero for all columns is no word on coordinates.
    [[nodiscard]] bool holds(std::string_view text, double value) const {
        return std::ranges::find(codes_, value) != codes_.end() || says_null(nulls_, names_, text, value, value != 0);
    }

  private:
    const std::vector<NullValue>& nulls_;
    std::vector<std::string> names_;
    std::vector<double> codes_;
};

/// All that is needed to read the position in a row.
struct PositionReader {
    const Table& table;
    const Crs& crs;
    PositionColumns columns;
    double height_factor = 1;           ///< to the CRS's unit, negative where they count downwards
    std::vector<NoCoordinates> none{};  ///< an axis each
    std::vector<Vec3> numbers{};        ///< a row each: what stands in the columns, NaN where that is no number
    bool plain = false;                 ///< numbers that stand in columns are coordinates, whatever they are
};

/// Each cell is looked at once: what is no number, and what may stand for none, is looked at again by its row.
PositionReader position_reader(const Table& table, const Crs& crs, const PositionColumns& columns, double height_factor,
                               const std::vector<NullValue>& nulls) {
    PositionReader reader{table, crs, columns, height_factor};
    reader.numbers.assign(table.rows(), nowhere);
    reader.plain = columns.plane() && columns.z >= 0;
    std::vector<double> values(table.rows());
    int axis = 0;
    for (const auto& [column, meaning] : {std::pair{columns.x, "x"}, {columns.y, "y"}, {columns.z, "z"}}) {
        for (std::size_t row = 0; row < table.rows() && column >= 0; ++row) {
            values[row] = parse_number(cell(table, column, row)).value_or(missing);
            reader.numbers[row][axis] = values[row];
        }
        reader.none.emplace_back(table, column, meaning, values, nulls);
        reader.plain = reader.plain && reader.none.back().empty();
        ++axis;
    }
    return reader;
}

/// Degrees, minutes and seconds on axis 0 (longitude) or 1, or why they are none here.
std::optional<double> degrees_in(std::string_view text, int axis, const Crs& crs, std::string& problem) {
    const std::optional<Degrees> degrees = axis < 2 && !crs.local ? parse_degrees(text) : std::nullopt;
    if (!degrees) {
        return std::nullopt;
    }
    const bool latitude = degrees->hemisphere == 'N' || degrees->hemisphere == 'S';
    const bool longitude = degrees->hemisphere == 'E' || degrees->hemisphere == 'W';
    if (!crs.geographic) {
        problem = fmt::format("'{}' is an angle, but the coordinate system is {}; add srs=EPSG:4326 to the file", text,
                              crs.name);
    } else if ((axis == 0 && latitude) || (axis == 1 && longitude)) {
        problem = fmt::format("'{}' is a {}; are x and y exchanged?", text, latitude ? "latitude" : "longitude");
    }
    return problem.empty() ? std::optional(degrees->value) : std::nullopt;
}

/// One axis of one row, or why there is none.
double coordinate(const PositionReader& reader, int axis, int column, std::size_t row, double in_geometry,
                  std::string& problem) {
    const Table& table = reader.table;
    if (column < 0) {
        if (std::isnan(in_geometry)) {
            problem = "the point has no height";
        }
        return in_geometry;
    }
    const std::string_view text = cell(table, column, row);
    std::optional<double> value = parse_number(text);
    if (value && reader.none[static_cast<std::size_t>(axis)].holds(text, *value)) {
        problem = fmt::format("column {}: {} stands for no value", header(table, column), text);
        return missing;
    }
    if (!value && !(value = degrees_in(text, axis, reader.crs, problem)) && problem.empty()) {
        problem = text.empty() ? fmt::format("column {} is empty", header(table, column))
                               : fmt::format("column {}: '{}' is not a number", header(table, column), text);
    }
    return value.value_or(missing) * (axis == 2 ? reader.height_factor : 1);
}

/// A row's position; nowhere, with the reason in `problem`, when it has none that is acceptable.
Vec3 position(const PositionReader& reader, std::size_t row, std::string& problem) {
    const Table& table = reader.table;
    const Crs& crs = reader.crs;
    const PositionColumns& columns = reader.columns;
    const bool from_columns = columns.plane();
    if (!from_columns && !table.points[row]) {
        problem = "no point geometry";
        return nowhere;
    }
    Vec3 result = reader.numbers[row];
    result.z *= reader.height_factor;
    if (!reader.plain || !is_finite(result)) {
        const Vec3 point = table.points.empty() ? nowhere : table.points[row].value_or(nowhere);
        result = {coordinate(reader, 0, from_columns ? columns.x : -1, row, point.x, problem),
                  coordinate(reader, 1, from_columns ? columns.y : -1, row, point.y, problem),
                  coordinate(reader, 2, columns.z, row, point.z, problem)};
    }
    if (!problem.empty()) {
        return nowhere;
    }
    if (!is_acceptable(result)) {
        problem = fmt::format("position {}, {}, {} is beyond {:g}", result.x, result.y, result.z, max_coordinate);
    } else if (crs.geographic && (std::abs(result.x) > 360 || std::abs(result.y) > 90)) {
        problem =
            fmt::format("{}, {} is no longitude and latitude, which {} asks for; {}", result.x, result.y, crs.name,
                        std::abs(result.x) <= 90 && std::abs(result.y) <= 360
                            ? "exchanged they would be: name the columns, or give the right system with -s_srs or srs="
                            : "give the right system with -s_srs or srs=");
    }
    return problem.empty() ? result : nowhere;
}

/// Columns called longitude and latitude that hold degrees, in a CRS that is not of degrees: a slip that would put all
/// of the data within a few metres of the origin.
void refuse_degrees_in_plane(const PlacedTable& placed, const PositionColumns& columns) {
    if (placed.crs.geographic || placed.crs.local || !names_degrees(placed.table, columns)) {
        return;
    }
    const bool degrees = std::ranges::all_of(placed.points, [](const Vec3& point) {
        return !is_finite(point) || (std::abs(point.x) <= 360 && std::abs(point.y) <= 90);
    });
    if (degrees) {
        throw InputError(fmt::format(
            "{}: columns {} and {} hold degrees, but its coordinate system is {}; add "
            "srs=EPSG:4326 to the file",
            placed.table.file, header(placed.table, columns.x), header(placed.table, columns.y), placed.crs.name));
    }
}

void require_usable_row(const PlacedTable& placed, const Diagnostics& diagnostics, std::size_t first_rejection) {
    if (std::ranges::none_of(placed.points, is_finite)) {
        throw_no_usable_row(placed.table, diagnostics, first_rejection);
    }
}

}  // namespace

PlacedTable place(Table table, const Source& source, const std::string& general_crs, const ColumnNames& names,
                  Diagnostics& diagnostics, const PlaceOptions& options) {
    const std::size_t first_rejection = diagnostics.rejected.size();
    const PositionColumns columns = choose_columns(table, names, diagnostics);
    const std::string hint = names_degrees(table, columns)
                                 ? fmt::format(" (its columns {} and {} look like EPSG:4326)", header(table, columns.x),
                                               header(table, columns.y))
                                 : "";
    Crs crs = resolved_crs(source, table.crs, general_crs, hint);
    PlacedTable placed{std::move(table), std::move(crs), {}};
    const Table& held = placed.table;
    PositionReader reader = position_reader(held, placed.crs, columns,
                                            height_sign(held, columns, options.z_positive, diagnostics) *
                                                height_factor(held, columns, placed.crs, diagnostics),
                                            options.nulls);
    for (std::size_t row = 0; row < placed.table.rows(); ++row) {
        std::string problem;
        reader.numbers[row] = position(reader, row, problem);
        if (!problem.empty()) {
            diagnostics.reject(placed.table.file, placed.table.lines[row], problem);
        }
    }
    placed.points = std::move(reader.numbers);
    if (options.some_usable) {
        require_usable_row(placed, diagnostics, first_rejection);
    }
    refuse_degrees_in_plane(placed, columns);
    if (const std::string remark = outside_area_of_use(placed.points, placed.crs); !remark.empty()) {
        diagnostics.note(held.file + ": " + remark);
    }
    return placed;
}

void to_crs(PlacedTable& placed, const Crs& target, Diagnostics& diagnostics, bool some_usable) {
    const std::size_t first_rejection = diagnostics.rejected.size();
    for (const Vec3& point : placed.points) {
        placed.own_heights.push_back(point.z);
    }
    const CrsTransform transform(placed.crs, target);
    placed.north_deg.assign(placed.points.size(), 0);
    if (transform.identity()) {
        placed.crs = target;
        return;
    }
    for (std::size_t row = 0; row < placed.points.size(); ++row) {
        placed.north_deg[row] = placed.usable(row) ? transform.north_deg(placed.points[row]) : missing;
    }
    const std::vector<Vec3> before = placed.points;
    transform.apply(placed.points);
    for (std::size_t row = 0; row < placed.points.size(); ++row) {
        if (is_finite(before[row]) && !is_acceptable(placed.points[row])) {
            placed.points[row] = nowhere;
            diagnostics.reject(placed.table.file, placed.table.lines[row],
                               fmt::format("{}, {} cannot be transformed from {} to {}", before[row].x, before[row].y,
                                           placed.crs.name, target.name));
        }
    }
    if (some_usable) {
        require_usable_row(placed, diagnostics, first_rejection);
    }
    if (const std::string remark = transform.remark(); !remark.empty()) {
        diagnostics.note(placed.table.file + ": " + remark);
    }
    placed.crs = target;
}

Crs resolved_crs(const Source& source, const Crs& in_file, const std::string& general_crs, const std::string& hint) {
    if (!source.srs.empty()) {
        return parse_crs(source.srs);
    }
    if (!in_file.empty()) {
        return in_file;
    }
    if (!general_crs.empty()) {
        return parse_crs(general_crs);
    }
    throw InputError(source.describe() +
                     ": no coordinate system is known; name it with -s_srs, or for this file with srs= after it "
                     "(EPSG:3067, say, or local where there is none)" +
                     hint);
}

void throw_no_usable_row(const Table& table, const Diagnostics& diagnostics, std::size_t first_rejection) {
    std::string reason;
    if (first_rejection < diagnostics.rejected.size()) {
        const Rejected& first = diagnostics.rejected[first_rejection];
        reason = fmt::format("; the first, line {}: {}", first.line, first.reason);
    }
    throw InputError(fmt::format("{}: none of its {} rows is usable{}", table.file, table.rows(), reason));
}

}  // namespace terratet
