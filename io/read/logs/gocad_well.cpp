// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GOCAD wells (.wl): a reference point and a path, as points (PATH), stations (STATION) or vertices (VRTX); markers,
// zones and curves of values.
#include <cpl_conv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/base/lower_case.hpp"
#include "io/base/text_lines.hpp"
#include "io/read/logs/well_file.hpp"
#include "io/read/logs/well_words.hpp"
#include "tess/borehole.hpp"
#include "tess/error.hpp"

namespace terratet {

namespace {

constexpr std::size_t most_rows = 50'000'000;

struct Curve {
    std::string name;
    std::string unit;
    std::optional<double> none;
    std::vector<std::pair<double, double>> values;
    std::vector<std::int64_t> lines;
};

struct Named {
    std::string name;
    double from = 0;
    double to = 0;
    std::int64_t line = 0;
};

struct Well {
    std::string name;
    std::optional<Vec3> reference;
    std::vector<double> depths;
    std::vector<Vec3> path;
    std::vector<SurveyStation> stations;
    std::vector<Named> markers;
    std::vector<Named> zones;
    std::vector<Curve> curves;
    bool z_down = false;
    bool binary = false;
};

class GocadWells {
  public:
    explicit GocadWells(const Source& source) : file_(source.describe()), path_(source.path) {}

    WellFile read() {
        LineReader reader(path_);
        std::string_view line;
        while (reader.next(line)) {
            take(trimmed(line), reader.number());
        }
        end_well();
        result_.format = "GOCAD well";
        if (wells_ == 0) {
            throw InputError(file_ + ": no GOCAD Well in it");
        }
        for (auto* tables : {&result_.logs, &result_.surveys}) {
            std::ranges::for_each(*tables, [](Table& table) { table.stated.one_of_several = true; });
        }
        return std::move(result_);
    }

  private:
    bool numbers(std::string_view text, std::initializer_list<double*> targets) {
        for (double* const target : targets) {
            const auto number = whole_number<double>(next_word(text));
            if (!number || !std::isfinite(*number)) {
                return false;
            }
            *target = *number;
        }
        return true;
    }

    void reject(std::int64_t line, std::string_view what) {
        if (result_.rejected.size() < 1000) {
            result_.rejected.emplace_back(line, fmt::format("'{}' is not understood", excerpt(what)));
        }
    }

    void take(std::string_view text, std::int64_t line) {
        std::string_view rest = text;
        const std::string_view word = next_word(rest);
        double a = 0;
        double b = 0;
        double c = 0;
        double d = 0;
        if (word == "GOCAD") {
            end_well();
            in_well_ = next_word(rest) == "Well";
            wells_ += in_well_ ? 1 : 0;
            well_ = {};
            return;
        }
        if (!in_well_) {
            return;
        }
        if (text.starts_with("name:") && !in_curve_) {
            well_.name = to_utf8(trimmed(text.substr(5)));
        } else if (word == "ZPOSITIVE") {
            well_.z_down = next_word(rest) == "Depth";
        } else if (word == "WREF") {
            if (numbers(rest, {&a, &b, &c})) {
                well_.reference = Vec3{a, b, c};
            } else {
                reject(line, text);
            }
        } else if (word == "PATH" || word == "TVSS_PATH") {
            if (numbers(rest, {&a, &b, &c, &d}) && well_.reference) {
                add_point(a, Vec3{well_.reference->x + c, well_.reference->y + d, b});
            } else {
                reject(line, text);
            }
        } else if (word == "STATION") {
            if (numbers(rest, {&a, &b, &c})) {
                well_.stations.push_back({a, c, b});
            } else {
                reject(line, text);
            }
        } else if (word == "VRTX" || word == "PVRTX") {
            if (numbers(rest, {&d, &a, &b, &c})) {
                const Vec3 point{a, b, c};
                const double before =
                    well_.depths.empty() ? 0 : well_.depths.back() + length(point - well_.path.back());
                add_point(before, point);
            } else {
                reject(line, text);
            }
        } else if (word == "MRKR") {
            const std::string name = to_utf8(next_word(rest));
            next_word(rest);
            if (numbers(rest, {&a})) {
                well_.markers.push_back({name, a, a, line});
            } else {
                reject(line, text);
            }
        } else if (word == "ZONE") {
            const std::string name = to_utf8(next_word(rest));
            if (numbers(rest, {&a, &b})) {
                well_.zones.push_back({name, a, b, line});
            } else {
                reject(line, text);
            }
        } else {
            take_curve(word, rest, text, line);
        }
    }

    void take_curve(std::string_view word, std::string_view rest, std::string_view text, std::int64_t line) {
        double a = 0;
        double b = 0;
        if (word == "WELL_CURVE") {
            in_curve_ = true;
            well_.curves.emplace_back();
        } else if (word == "END_CURVE") {
            in_curve_ = false;
        } else if (in_curve_) {
            Curve& curve = well_.curves.back();
            if (word == "PROPERTY" || word == "PROPERTY:") {
                curve.name = to_utf8(trimmed(rest));
            } else if (word == "UNITS" || word == "PROP_UNIT") {
                curve.unit = to_utf8(trimmed(rest));
                curve.unit = lower_case(curve.unit) == "none" ? "" : curve.unit;
            } else if (word == "PROP_NO_DATA_VALUE" || word == "NO_DATA_VALUE") {
                curve.none = whole_number<double>(next_word(rest));
            } else if (word == "REC") {
                if (numbers(rest, {&a, &b})) {
                    curve.values.emplace_back(a, b);
                    curve.lines.push_back(line);
                } else {
                    reject(line, text);
                }
            } else if (word == "SEEK") {
                well_.binary = true;
            }
        }
    }

    void add_point(double depth, const Vec3& point) {
        if (well_.depths.size() < most_rows && (well_.depths.empty() ? depth >= 0 : depth > well_.depths.back())) {
            well_.depths.push_back(depth);
            well_.path.push_back(point);
        }
    }

    /// A table of one hole: depths, or tops and bases, and one column.
    void add_log(const std::string& what, const std::string& unit, const std::vector<Named>& rows,
                 const std::vector<std::string>& cells, bool intervals) {
        if (rows.empty()) {
            return;
        }
        LogTable table(fmt::format("{} ({}: {})", file_, well_.name, what));
        table.add_column("top", "");
        table.add_column("base", "");
        table.add_column(what, unit);
        for (std::size_t row = 0; row < rows.size(); ++row) {
            table.add_row({fmt::format("{}", rows[row].from), fmt::format("{}", rows[row].to), cells[row]},
                          rows[row].line, 1U << 20U | rows.size() * 4);
        }
        Table finished = table.finish();
        if (intervals) {
            finished.stated.meanings = {{Meaning::from, 0}, {Meaning::to, 1}};
        } else {
            finished.stated.meanings = {{Meaning::depth, 0}};
            finished.stated.asides = {1};
        }
        finished.stated.hole_names = {well_.name};
        result_.logs.push_back(std::move(finished));
    }

    void end_well() {
        if (!in_well_) {
            return;
        }
        in_well_ = false;
        in_curve_ = false;
        if (well_.name.empty()) {
            well_.name = CPLGetBasename(path_.c_str());
        }
        result_.facts.emplace_back("well", well_.name);
        if (result_.collars.columns.empty()) {
            result_.collars = collar_table(file_);
        }
        const double up = well_.z_down ? -1 : 1;
        for (Vec3& point : well_.path) {
            point.z *= up;
        }
        if (!well_.reference && !well_.path.empty()) {
            well_.reference = well_.path.front();
        } else if (well_.reference) {
            well_.reference->z *= up;
        }
        if (well_.reference) {
            const Vec3& at = well_.path.empty() ? *well_.reference : well_.path.front();
            add_collar(result_.collars, well_.name, fmt::format("{}", at.x), fmt::format("{}", at.y),
                       fmt::format("{}", at.z), "", 1);
        }
        if (well_.path.size() > 1) {
            result_.paths.push_back({well_.name, well_.depths, well_.path});
        } else if (!well_.stations.empty()) {
            add_survey();
        }
        add_logs();
    }

    void add_survey() {
        LogTable table(fmt::format("{} ({})", file_, well_.name));
        for (const char* name : {"DEPTH", "AZIMUTH", "INCLINATION"}) {
            table.add_column(name, "");
        }
        for (const SurveyStation& station : well_.stations) {
            table.add_row({fmt::format("{}", station.depth), fmt::format("{}", station.azimuth_deg),
                           fmt::format("{}", station.inclination_deg)},
                          1, 1U << 20U | well_.stations.size() * 4);
        }
        Table survey = table.finish();
        survey.stated.meanings = {{Meaning::depth, 0}, {Meaning::azimuth, 1}, {Meaning::dip, 2}};
        survey.stated.inclination = true;
        survey.stated.hole_names = {well_.name};
        result_.surveys.push_back(std::move(survey));
    }

    void add_logs() {
        for (const Curve& curve : well_.curves) {
            std::vector<Named> rows;
            std::vector<std::string> cells;
            for (std::size_t i = 0; i < curve.values.size(); ++i) {
                const auto& [depth, value] = curve.values[i];
                rows.push_back({"", depth, depth, curve.lines[i]});
                cells.push_back(curve.none == value ? "" : fmt::format("{}", value));
            }
            add_log(curve.name.empty() ? "CURVE" : curve.name, curve.unit, rows, cells, false);
        }
        for (const auto& [what, rows] : {std::pair("MARKER", &well_.markers), std::pair("ZONE", &well_.zones)}) {
            std::vector<std::string> cells;
            std::ranges::transform(*rows, std::back_inserter(cells), &Named::name);
            add_log(what, "", *rows, cells, rows == &well_.zones);
        }
        if (well_.binary) {
            result_.notes.push_back(fmt::format(
                "{}: its curves lie in a binary file beside it and are not read; save the well as ASCII", well_.name));
        }
    }

    std::string file_;
    std::string path_;
    Well well_;
    bool in_well_ = false;
    bool in_curve_ = false;
    std::size_t wells_ = 0;
    WellFile result_;
};

}  // namespace

WellFile read_gocad_well(const Source& source) {
    return GocadWells(source).read();
}

}  // namespace terratet
