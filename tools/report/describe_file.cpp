// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/read/logs/well_file.hpp"
#include "io/read/meshes/read_mesh.hpp"
#include "io/read/site/hole_layers.hpp"
#include "io/read/site/input_files.hpp"
#include "io/write/seen_output.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"
#include "tools/options/field_names.hpp"
#include "tools/options/text.hpp"
#include "tools/report/describe.hpp"
#include "tools/report/describe_parts.hpp"
#include "tools/report/diagnostics_json.hpp"

namespace terratet::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_shown = 200;

std::string counted(std::size_t count, const std::string& what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// A list of texts, cut where it would fill the screen.
Json list_json(std::vector<std::string> items) {
    const std::size_t more = items.size() > most_shown ? items.size() - most_shown : 0;
    items.resize(items.size() - more);
    if (more > 0) {
        items.push_back(fmt::format("and {} more", more));
    }
    return items;
}

// --- Columns -------------------------------------------------------------------------------------------------------

Json column_json(const Table& table, std::size_t c) {
    Range range;
    std::size_t empty = 0;
    std::size_t censored = 0;
    for (const std::string_view cell : table.cells[c]) {
        range.add(parse_number(cell).value_or(NAN));
        censored += parse_bound(cell) ? 1 : 0;
        empty += cell.empty() ? 1 : 0;
    }
    Json column{{"name", table.columns[c]}};
    if (!table.stated.units.empty() && !table.stated.units[c].empty()) {
        column["unit"] = table.stated.units[c];
    }
    if (range.count > 0) {
        column["min"] = range.lo;
        column["max"] = range.hi;
    }
    column["numbers"] = range.count;
    if (censored > 0) {
        column["censored"] = censored;
    }
    column["words"] = table.rows() - range.count - censored - empty;
    column["empty"] = empty;
    return column;
}

Json columns_json(const Table& table) {
    Json columns = Json::array();
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        columns.push_back(column_json(table, c));
    }
    return columns;
}

/// Which column is taken for what.
Json meanings_json(const Table& table, const ColumnNames& names) {
    Json meanings = Json::object();
    for (const Meaning meaning : {Meaning::id, Meaning::x, Meaning::y, Meaning::z, Meaning::from, Meaning::to,
                                  Meaning::depth, Meaning::azimuth, Meaning::dip, Meaning::length}) {
        if (const int column = find_optional_column(table, meaning, names); column >= 0) {
            meanings[to_string(meaning)] = table.columns[static_cast<std::size_t>(column)];
        }
    }
    return meanings;
}

/// Cells of columns that must be numbers, and are none.
Json defects_json(const Table& table, const ColumnNames& names) {
    Json defects = Json::array();
    for (const Meaning meaning : {Meaning::x, Meaning::y, Meaning::z, Meaning::from, Meaning::to, Meaning::depth,
                                  Meaning::azimuth, Meaning::dip, Meaning::length}) {
        const int column = find_optional_column(table, meaning, names);
        std::size_t count = 0;
        std::string first;
        for (std::size_t row = 0; column >= 0 && row < table.rows(); ++row) {
            const std::string_view cell = table.cells[static_cast<std::size_t>(column)][row];
            if (!cell.empty() && !parse_number(cell) && count++ == 0) {
                first = fmt::format("line {}: '{}'", table.lines[row], cell);
            }
        }
        if (count > 0) {
            defects.push_back(fmt::format("column {}: {} of {} cells are no number; the first on {}",
                                          table.columns[static_cast<std::size_t>(column)], count, table.rows(), first));
        }
    }
    const int id = find_optional_column(table, Meaning::id, names);
    if (id >= 0) {
        const auto empty = std::ranges::count(table.cells[static_cast<std::size_t>(id)], std::string_view());
        if (empty > 0) {
            defects.push_back(fmt::format("column {}: {} of {} records have no id",
                                          table.columns[static_cast<std::size_t>(id)], empty, table.rows()));
        }
    }
    return defects;
}

Json describe_named_table(const Table& table, const ColumnNames& names) {
    const LayerUse use = use_of(table, !table.points.empty(), names);
    Json json{{"kind", "table"}};
    if (use != LayerUse::other) {
        json["use"] = to_string(use);
    }
    json["crs"] = crs_text(table.crs.name);
    json["rows"] = table.rows();
    Box3 box;
    for (const auto& point : table.points) {
        if (point) {
            box.extend(*point);
        }
    }
    if (!box.empty()) {
        json["extent"] = box_json(box);
    }
    if (Json meanings = meanings_json(table, names); !meanings.empty()) {
        json["meanings"] = std::move(meanings);
    }
    json["columns"] = columns_json(table);
    if (Json defects = defects_json(table, names); !defects.empty()) {
        json["defects"] = std::move(defects);
    }
    if (!table.notes.empty()) {
        json["notes"] = list_json(table.notes);
    }
    return json;
}

// --- Wells ---------------------------------------------------------------------------------------------------------

/// The depths of a log, in its own unit.
Json depths_json(const Table& log) {
    Range range;
    for (const Meaning meaning : {Meaning::from, Meaning::to, Meaning::depth}) {
        if (const int column = log.stated.column(meaning); column >= 0) {
            for (const std::string_view cell : log.cells[static_cast<std::size_t>(column)]) {
                range.add(parse_number(cell).value_or(NAN));
            }
        }
    }
    return range.count > 0 ? Json{range.lo, range.hi} : Json();
}

std::string well_summary(const WellFile& file) {
    std::string text = file.format;
    if (file.format.starts_with("LAS") && !file.logs.empty()) {
        text += ", " + counted(file.logs.front().columns.size(), "curve");
    }
    if (file.format.starts_with("AGS")) {
        text += ", " + counted(file.collars.rows(), "hole") + " with a place, " + counted(file.logs.size(), "group") +
                " with depths";
    }
    for (const auto& [fact, value] : file.facts) {
        if (fact == "well") {
            text += ", well " + value;
        }
    }
    return text;
}

Json describe_well(const Source& source) {
    const WellFile file = read_well_file(source);
    Json json{{"summary", well_summary(file)}, {"kind", "log"}, {"format", file.format}};
    if (file.format.starts_with("LAS") && !file.logs.empty()) {
        json["curves"] = file.logs.front().columns.size();
    }
    for (const auto& [fact, value] : file.facts) {
        json[fact] = value;
    }
    json["crs"] = crs_text(file.collars.crs.name);
    Box3 box;
    Json collars = Json::array();
    for (std::size_t row = 0; row < file.collars.rows(); ++row) {
        const auto cell = [&](std::size_t column) { return file.collars.cells[column][row]; };
        const auto number = [&](std::size_t column) { return parse_number(cell(column)).value_or(missing); };
        const Vec3 place{number(1), number(2), number(3)};
        if (is_finite(place)) {
            box.extend(place);
        }
        if (row < most_shown) {
            collars.push_back({{"name", std::string(cell(0))}, {"x", place.x}, {"y", place.y}, {"z", place.z}});
        }
    }
    json["extent"] = box_json(box);
    json["collars"] = std::move(collars);
    if (!file.surveys.empty()) {
        json["survey_stations"] = file.surveys.front().rows();
    }
    if (!file.paths.empty()) {
        json["path_points"] = file.paths.front().points.size();
    }
    json["logs"] = Json::array();
    for (const Table& log : file.logs) {
        const double metres = log.stated.metres_per_depth;
        const int depth = std::max(log.stated.column(Meaning::from), log.stated.column(Meaning::depth));
        const std::string unit =
            depth >= 0 && !log.stated.units.empty() ? log.stated.units[static_cast<std::size_t>(depth)] : "";
        json["logs"].push_back({{"name", log.file},
                                {"rows", log.rows()},
                                {"depths", depths_json(log)},
                                {"unit", unit.empty() ? (metres == 1 ? "m" : "not said") : unit},
                                {"columns", log.columns.size()}});
    }
    for (const Table& log : file.logs) {
        const std::string key =
            file.logs.size() == 1 ? "columns" : "columns of " + log.file.substr(log.file.rfind('/') + 1);
        json[key] = columns_json(log);
    }
    json["rejected"] = file.rejected.size();
    std::vector<std::string> defects;
    for (const auto& [line, reason] : file.rejected) {
        defects.push_back(line > 0 ? fmt::format("line {}: {}", line, reason) : reason);
    }
    if (!defects.empty()) {
        json["defects"] = list_json(std::move(defects));
    }
    if (!file.notes.empty()) {
        json["notes"] = list_json(file.notes);
    }
    return json;
}

// --- The rest ------------------------------------------------------------------------------------------------------

Json describe_output(const SeenOutput& seen) {
    Json json{
        {"kind", "output"}, {"format", seen.format}, {"crs", crs_text(seen.crs)}, {"extent", box_json(seen.extent)}};
    for (const auto& [fact, value] : seen.facts) {
        if (!value.empty()) {
            json[fact] = value;
        }
    }
    for (const auto& [name, items] : seen.lists) {
        if (!items.empty()) {
            json[name] = list_json(items);
        }
    }
    return json;
}

/// A folder or a pattern: what each file is, in a line.
Json describe_files(const std::vector<Source>& files) {
    Json json{{"kind", "files"}, {"count", files.size()}, {"files", Json::array()}};
    for (const Source& file : files) {
        std::string what;
        try {
            const auto seen = see_output(file.path);
            what = well_format(file.path) != WellFormat::none ? well_summary(read_well_file(file))
                   : seen                                     ? seen->format
                                                              : "no log";
        } catch (const InputError& error) {
            what = error.what();
        }
        json["files"].push_back({{"name", file.path}, {"is", what}});
    }
    return json;
}

/// A layer of triangles is a table too, of attributes only: what it is for are its surfaces.
Json describe_table_or_surfaces(const Source& source, const ColumnNames& names) {
    Diagnostics diagnostics;
    const auto surfaces = [&] {
        return describe_surfaces(read_surfaces(source, SurfaceKind::fault, names, diagnostics), diagnostics);
    };
    if (is_gocad(source.path) || mesh_format(source.path)) {
        return surfaces();
    }
    const Table table = read_table(source);
    if (table.points.empty() && find_optional_column(table, Meaning::x, names) < 0) {
        try {
            return surfaces();
        } catch (const InputError&) {
            // A plain table, then.
        }
    }
    return describe_named_table(table, names);
}

}  // namespace

Json describe_file(const Source& source, const ColumnNames& names) {
    const std::vector<Source> files = files_of(source);
    if (files.size() != 1 || files.front().path != source.path) {
        return describe_files(files);
    }
    if (const auto seen = see_output(source.path)) {
        return describe_output(*seen);
    }
    if (source.layer.empty() && source.sql.empty() && well_format(source.path) != WellFormat::none) {
        return describe_well(source);
    }
    Json layers = Json::array();
    if (!is_gocad(source.path) && !mesh_format(source.path)) {
        try {
            for (const HoleLayer& layer : hole_layers(source, names)) {
                layers.push_back(
                    {{"name", layer.name}, {"use", to_string(layer.use)}, {"columns", list_json(layer.columns)}});
            }
        } catch (const InputError&) {
            // No table: the readers of surfaces say what it is.
        }
    }
    Json json = describe_table_or_surfaces(source, names);
    if (layers.size() > 1) {
        json["layers"] = std::move(layers);
    }
    return json;
}

Json describe_holes(const HoleQuality& quality, const Diagnostics& diagnostics) {
    Json json{{"kind", "holes"},
              {"holes", quality.holes.size()},
              {"surveyed", quality.surveyed},
              {"logged", quality.logged},
              {"findings", quality.findings.size()}};
    json["worst"] = quality.worst() != nullptr && quality.worst()->findings > 0 ? Json(quality.worst()->id) : Json();
    json["counts"] = Json::object();
    for (int defect = 0; defect <= static_cast<int>(HoleDefect::bad_record); ++defect) {
        const auto found = quality.counts.find(static_cast<HoleDefect>(defect));
        json["counts"][to_string(static_cast<HoleDefect>(defect))] = found == quality.counts.end() ? 0 : found->second;
    }
    json["list"] = Json::array();
    for (const HoleFinding& finding : quality.findings) {
        Json row{{"hole", finding.hole}, {"defect", to_string(finding.defect)}, {"text", finding.text}};
        if (!std::isnan(finding.from)) {
            row["from"] = finding.from;
            row["to"] = finding.to;
        }
        if (!finding.file.empty()) {
            row["file"] = finding.file;
        }
        if (finding.line > 0) {
            row["line"] = finding.line;
        }
        json["list"].push_back(std::move(row));
    }
    json["notes"] = notes_json(diagnostics);
    return json;
}

}  // namespace terratet::tools
