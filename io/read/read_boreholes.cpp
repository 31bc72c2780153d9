// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/read_boreholes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "io/read/tables/header_units.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {

namespace {

std::string number(double value) {
    return fmt::format("{}", value);
}

std::string_view cell(const Table& table, int column, std::size_t row) {
    return table.cells[static_cast<std::size_t>(column)][row];
}

const std::string& header(const Table& table, int column) {
    return table.columns[static_cast<std::size_t>(column)];
}

int require_column(const Table& table, Meaning meaning, const ColumnNames& names) {
    const int column = find_column(table, meaning, names);
    if (column < 0) {
        throw InputError(fmt::format("{}: no column for {}; columns: {}; name one with `columns` {}=NAME", table.file,
                                     to_string(meaning), fmt::join(table.columns, ", "), to_string(meaning)));
    }
    return column;
}

// --- Units ---------------------------------------------------------------------------------------------------------

/// Metres in a unit of depth: what the user says, else the unit of the collars' own plane (metres for degrees).
double metres_per_depth(const Crs& collar_crs, const std::string& depth_unit) {
    return depth_unit.empty() ? collar_crs.metres_per_unit : metres_in_unit(depth_unit);
}

/// The two kinds of foot differ by two parts in a million.
bool same_unit(double metres, double other) {
    return std::abs(metres / other - 1) < 1e-5;
}

/// Exactly 1 between the two kinds of foot, which differ by two parts in a million.
double depth_factor(const Crs& collar_crs, const Crs& target, const std::string& depth_unit) {
    const double factor = metres_per_depth(collar_crs, depth_unit) / target.metres_per_unit;
    return std::abs(factor - 1) < 1e-5 ? 1 : factor;
}

void note_depth_unit(const Table& table, const Crs& collar_crs, const Crs& target, const SiteInputs& inputs,
                     Diagnostics& diagnostics) {
    const double ratio = collar_crs.metres_per_height / collar_crs.metres_per_unit;
    if (inputs.depth_unit.empty() && !collar_crs.geographic && std::abs(ratio - 1) > 1e-5) {
        diagnostics.note(
            fmt::format("{}: heights and plane of {} have different units; depths along its holes are taken in {}, the "
                        "plane's (`depth_unit` says otherwise)",
                        table.file, collar_crs.name, collar_crs.unit));
    } else if (inputs.depth_unit.empty() && depth_factor(collar_crs, target, "") != 1) {
        diagnostics.note(
            fmt::format("{}: depths along its holes are taken in {}, the unit of {} (`depth_unit` says otherwise)",
                        table.file, collar_crs.geographic ? "metre" : collar_crs.unit, collar_crs.name));
    }
}

// --- Dips ----------------------------------------------------------------------------------------------------------

/// A header that says "from the vertical" rather than "from the horizontal".
bool named_inclination(const std::string& column) {
    static constexpr std::array<std::string_view, 4> names{"inclination", "incl", "inc", "devi"};
    return std::ranges::find(names, normal_header(column)) != names.end();
}

const char* describe(DipConvention convention) {
    switch (convention) {
        case DipConvention::down_positive:
            return "positive downwards from the horizontal";
        case DipConvention::down_negative:
            return "negative downwards from the horizontal";
        default:
            return "inclination from the downward vertical";
    }
}

/// What a column of dips means: as told; by its name where all values are 0…180; else by the majority of the signs.
DipConvention dip_convention(const Table& table, int column, DipConvention told, Diagnostics& diagnostics) {
    if (table.stated.inclination) {
        return DipConvention::inclination;
    }
    if (told != DipConvention::automatic) {
        return told;
    }
    std::size_t positive = 0;
    std::size_t negative = 0;
    bool all_inclinations = true;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const double dip = parse_number(cell(table, column, row)).value_or(0);
        positive += dip > 0 ? 1 : 0;
        negative += dip < 0 ? 1 : 0;
        all_inclinations = all_inclinations && dip >= 0 && dip <= 180;
    }
    const std::string& name = header(table, column);
    DipConvention result = negative > positive ? DipConvention::down_negative : DipConvention::down_positive;
    std::string why = fmt::format("{} values above zero, {} below", positive, negative);
    if (named_inclination(name) && all_inclinations) {
        result = DipConvention::inclination;
        why = "by its name and values of 0 to 180";
    }
    diagnostics.note(
        fmt::format("{}: column {} is read as {} ({}; `dip` says otherwise)", table.file, name, describe(result), why));
    return result;
}

/// Inclination from the downward vertical; NaN for what is no angle of that convention.
double inclination_deg(double dip, DipConvention convention) {
    const double result = convention == DipConvention::down_positive   ? 90 - dip
                          : convention == DipConvention::down_negative ? 90 + dip
                                                                       : dip;
    return result >= 0 && result <= 180 ? result : missing;
}

/// Direction of a hole as a record gives it.
struct Direction {
    double azimuth_deg = 0;
    double inclination_deg = 0;
};

/// The columns of directions of a table.
struct DirectionColumns {
    int azimuth = -1;
    int dip = -1;
    DipConvention convention = DipConvention::down_positive;
};

/// The direction in a row; nothing, with the reason in `problem`, when it has none. A vertical hole needs no azimuth.
std::optional<Direction> direction(const Table& table, const DirectionColumns& columns, std::size_t row,
                                   std::string& problem) {
    const std::string_view dip_text = cell(table, columns.dip, row);
    const std::optional<double> dip = parse_number(dip_text);
    const double inclination = inclination_deg(dip.value_or(missing), columns.convention);
    if (std::isnan(inclination)) {
        problem = fmt::format("column {}: '{}' is no {}", header(table, columns.dip), dip_text,
                              dip ? describe(columns.convention) : "number");
        return std::nullopt;
    }
    const std::string_view azimuth_text = columns.azimuth < 0 ? std::string_view{} : cell(table, columns.azimuth, row);
    const std::optional<double> azimuth = parse_number(azimuth_text);
    const bool vertical = std::abs(std::sin(inclination * std::acos(-1.0) / 180)) < 1e-9;
    // A turn more or less is the same direction; more than one is none.
    const bool no_angle = azimuth ? std::abs(*azimuth) >= 720 : !azimuth_text.empty() || !vertical;
    if (no_angle) {
        problem = azimuth_text.empty()
                      ? fmt::format("no azimuth beside the dip {}", *dip)
                      : fmt::format("column {}: '{}' is no azimuth", header(table, columns.azimuth), azimuth_text);
        return std::nullopt;
    }
    return Direction{azimuth.value_or(0), inclination};
}

// --- Collars -------------------------------------------------------------------------------------------------------

struct Collar {
    Vec3 position;
    double unit_factor = 1;
    double azimuth_shift = 0;  ///< what to add to an azimuth of the tables to count it from the target's grid north
    double length = 0;
    double own_height = 0;
    double height_factor = 1;
    std::optional<Direction> direction;  ///< from the collar's own record
};

using Collars = std::map<std::string, Collar>;

/// What to add to the azimuths of a hole; `north_deg` is where the north of its own CRS lies.
double azimuth_shift(const Vec3& position, double north_deg, const CrsTransform& in_target, const SiteInputs& inputs) {
    switch (inputs.azimuth) {
        case AzimuthReference::grid:
            return north_deg;
        case AzimuthReference::true_north:
            return in_target.convergence_deg(position);
        case AzimuthReference::magnetic:
            return in_target.convergence_deg(position) + inputs.declination_deg;
    }
    return 0;
}

DirectionColumns direction_columns(const Table& table, const SiteInputs& inputs, Diagnostics& diagnostics) {
    DirectionColumns columns{find_optional_column(table, Meaning::azimuth, inputs.columns),
                             find_optional_column(table, Meaning::dip, inputs.columns), DipConvention::down_positive};
    if (columns.dip >= 0) {
        columns.convention = dip_convention(table, columns.dip, inputs.dip, diagnostics);
    }
    return columns;
}

void read_collars(const PlacedTable& placed, const Crs& own_crs, const Crs& target, const SiteInputs& inputs,
                  Collars& collars, Diagnostics& diagnostics) {
    const Table& table = placed.table;
    const std::size_t first_rejection = diagnostics.rejected.size();
    const std::size_t before = collars.size();
    const int id_column = require_column(table, Meaning::id, inputs.columns);
    const int length_column = find_optional_column(table, Meaning::length, inputs.columns);
    const DirectionColumns columns = direction_columns(table, inputs, diagnostics);
    const CrsTransform in_target(target, target);
    const double factor = depth_factor(own_crs, target, inputs.depth_unit);
    const auto length_unit = inputs.depth_unit.empty() ? stated_length_unit(table, length_column) : std::nullopt;
    const double length_factor = length_unit ? length_unit->metres / target.metres_per_unit : factor;
    note_depth_unit(table, own_crs, target, inputs, diagnostics);
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const std::string id(cell(table, id_column, row));
        const auto reject = [&](const std::string& reason) {
            diagnostics.reject(table.file, table.lines[row], reason);
        };
        if (!placed.usable(row)) {
            continue;  // rejected when its position was read
        }
        if (id.empty()) {
            reject(fmt::format("column {}: no id", header(table, id_column)));
            continue;
        }
        Collar collar{placed.points[row],
                      factor,
                      0,
                      0,
                      placed.own_heights[row],
                      own_crs.metres_per_height / target.metres_per_unit,
                      std::nullopt};
        collar.azimuth_shift = azimuth_shift(placed.points[row], placed.north_deg[row], in_target, inputs);
        if (length_column >= 0 && parse_number(cell(table, length_column, row))) {
            std::string ignored;  // a length is a courtesy: a hole does without
            collar.length =
                std::max(0.0, parse_depth(table, length_column, row, length_factor, target.metres_per_unit, ignored));
        }
        if (columns.dip >= 0 && !cell(table, columns.dip, row).empty()) {
            std::string problem;
            collar.direction = direction(table, columns, row, problem);
            if (!problem.empty()) {
                reject(problem + "; the collar is used without its direction");
            }
        }
        if (!collars.emplace(id, collar).second) {
            reject(fmt::format("hole {}: a second collar; the first one counts", id));
        }
    }
    if (collars.size() == before) {
        throw_no_usable_row(table, diagnostics, first_rejection);
    }
}

// --- Surveys -------------------------------------------------------------------------------------------------------

using Surveys = std::map<std::string, std::map<double, SurveyStation>>;

void read_survey(const Table& table, const Collars& collars, const Crs& target, const SiteInputs& inputs,
                 Surveys& surveys, Diagnostics& diagnostics) {
    const std::size_t first_rejection = diagnostics.rejected.size();
    const bool one_hole = !table.stated.hole_names.empty();
    const int id_column = one_hole ? -1 : require_column(table, Meaning::id, inputs.columns);
    const int depth_column = require_column(table, Meaning::depth, inputs.columns);
    require_column(table, Meaning::dip, inputs.columns);
    require_column(table, Meaning::azimuth, inputs.columns);
    const DirectionColumns columns = direction_columns(table, inputs, diagnostics);
    bool any = false;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const std::string id(one_hole ? std::string_view(table.stated.hole_names.front())
                                      : cell(table, id_column, row));
        const auto collar = collars.find(id);
        std::string problem;
        if (collar == collars.end()) {
            problem = id.empty() ? "no id" : fmt::format("hole {} has no collar", id);
        }
        const double factor = problem.empty() ? depth_factor(table, collar->second.unit_factor, target) : 1;
        const double depth =
            problem.empty() ? parse_depth(table, depth_column, row, factor, target.metres_per_unit, problem) : 0;
        const std::optional<Direction> found = problem.empty() ? direction(table, columns, row, problem) : std::nullopt;
        if (problem.empty()) {
            const SurveyStation station{depth, found->azimuth_deg + collar->second.azimuth_shift,
                                        found->inclination_deg};
            const auto [known, added] = surveys[id].emplace(depth, station);
            if (!added && known->second != station) {
                problem = fmt::format("hole {}: a second, different station at depth {}; the first one counts", id,
                                      cell(table, depth_column, row));
            }
            any = true;
        }
        if (!problem.empty()) {
            diagnostics.reject(table.file, table.lines[row], problem);
        }
    }
    if (!any) {
        throw_no_usable_row(table, diagnostics, first_rejection);
    }
}

std::vector<SurveyStation> stations_of(const std::map<double, SurveyStation>& survey) {
    std::vector<SurveyStation> stations;
    stations.reserve(survey.size());
    for (const auto& [depth, station] : survey) {
        stations.push_back(station);
    }
    return stations;
}

}  // namespace

void take_stated_depth_unit(Table& table, const Crs& target, const SiteInputs& inputs, Diagnostics& diagnostics) {
    if (table.stated.metres_per_depth > 0) {
        return;
    }
    std::array columns{find_optional_column(table, Meaning::from, inputs.columns),
                       find_optional_column(table, Meaning::to, inputs.columns)};
    if (columns[0] < 0 || columns[1] < 0) {
        columns = {find_optional_column(table, Meaning::depth, inputs.columns), columns[0]};
    }
    std::optional<StatedUnit> unit;
    std::string column;
    for (const int index : columns) {
        const std::optional<StatedUnit> stated = stated_length_unit(table, index);
        if (inputs.depth_unit.empty() && stated && unit && !same_unit(stated->metres, unit->metres)) {
            throw InputError(fmt::format("{}: columns {} and {} state different units; `depth_unit` says which holds",
                                         table.file, column, header(table, index)));
        }
        if (stated && !unit) {
            unit = stated;
            column = header(table, index);
        }
    }
    if (!unit) {
        return;
    }
    if (!inputs.depth_unit.empty()) {
        if (!same_unit(unit->metres, metres_in_unit(inputs.depth_unit))) {
            diagnostics.note(
                fmt::format("{}: column {} states {}; its depths are taken in {} all the same, as asked for",
                            table.file, column, unit->text, inputs.depth_unit));
        }
        return;
    }
    table.stated.metres_per_depth = unit->metres;
    if (!same_unit(unit->metres, target.metres_per_unit)) {
        diagnostics.note(fmt::format("{}: depths are taken in {}, as column {} states (`depth_unit` says otherwise)",
                                     table.file, unit->text, column));
    }
}

double depth_factor(const Table& table, double hole_factor, const Crs& target) {
    const double factor = table.stated.metres_per_depth / target.metres_per_unit;
    return factor == 0 ? hole_factor : std::abs(factor - 1) < 1e-5 ? 1 : factor;
}

double parse_depth(const Table& table, int column, std::size_t row, double unit_factor, double metres_per_unit,
                   std::string& problem) {
    const std::string_view text = cell(table, column, row);
    const std::optional<double> value = parse_number(text);
    const std::string& name = header(table, column);
    if (!value) {
        problem = text.empty() ? fmt::format("column {} is empty", name)
                               : fmt::format("column {}: '{}' is not a number", name, text);
    } else if (*value < 0) {
        problem = fmt::format("column {}: negative depth {}", name, number(*value));
    } else if (*value * unit_factor * metres_per_unit > max_depth_m) {
        problem = fmt::format("column {}: depth {} is deeper than any hole ({:g} km)", name, number(*value),
                              max_depth_m / 1000);
    }
    return problem.empty() ? *value * unit_factor : -1;
}

Holes read_boreholes(const std::vector<PlacedTable>& collar_tables, const std::vector<Crs>& collar_crs,
                     const std::vector<Table>& survey_tables, const std::vector<HolePath>& paths, const Crs& target,
                     const SiteInputs& inputs, Diagnostics& diagnostics) {
    Collars collars;
    for (std::size_t i = 0; i < collar_tables.size(); ++i) {
        read_collars(collar_tables[i], collar_crs[i], target, inputs, collars, diagnostics);
    }
    Surveys surveys;
    for (const Table& table : survey_tables) {
        const std::string& own = table.stated.hole_names.empty() ? "" : table.stated.hole_names.front();
        if (own.empty() || !surveys.contains(own)) {  // a file's own survey stands behind a table of surveys
            read_survey(table, collars, target, inputs, surveys, diagnostics);
        }
    }
    Holes holes;
    std::size_t by_collar = 0;
    std::size_t vertical = 0;
    for (const auto& [id, collar] : collars) {
        std::vector<SurveyStation> stations;
        if (const auto path = std::ranges::find(paths, id, &HolePath::hole); path != paths.end()) {
            holes.emplace(id, Hole{id, Trajectory(path->depths, path->points), collar.unit_factor, path->depths.back(),
                                   collar.length});
            continue;
        }
        if (const auto survey = surveys.find(id); survey != surveys.end()) {
            stations = stations_of(survey->second);
        } else if (collar.direction) {
            stations = {{0, collar.direction->azimuth_deg + collar.azimuth_shift, collar.direction->inclination_deg}};
            ++by_collar;
        } else {
            ++vertical;
        }
        const double surveyed = stations.empty() ? 0 : stations.back().depth;
        holes.emplace(id, Hole{id, Trajectory(collar.position, std::move(stations), inputs.desurvey),
                               collar.unit_factor, surveyed});
        holes.at(id).deepest = collar.length;
    }
    std::int32_t index = 0;
    for (auto& [id, hole] : holes) {
        const Collar& collar = collars.at(id);
        hole.index = index++;
        hole.own_height = collar.own_height;
        hole.height_factor = collar.height_factor;
        hole.stated_length = collar.length;
    }
    if (by_collar > 0) {
        diagnostics.note(fmt::format("{} of {} holes have no survey and go straight in their collar's direction",
                                     by_collar, holes.size()));
    }
    if (vertical > 0) {
        diagnostics.note(fmt::format("{} of {} holes have no survey and no direction and are taken for vertical",
                                     vertical, holes.size()));
    }
    return holes;
}

}  // namespace terratet
