// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/site/hole_quality.hpp"
#include "io/read/log_intervals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include "io/read/join_ids.hpp"
#include "io/read/read_boreholes.hpp"
#include "io/read/site/hole_inputs.hpp"
#include "tess/error.hpp"
#include "tess/samples.hpp"

namespace terratet {

namespace {

constexpr std::array<const char*, 13> names{"overlap",           "gap",
                                            "missing survey",    "kink",
                                            "duplicate collar",  "duplicate place",
                                            "duplicate station", "duplicate interval",
                                            "without log",       "without collar",
                                            "beyond length",     "turned interval",
                                            "bad record"};

std::string metres(double value) {
    return fmt::format("{:.10g}", value);
}

/// The angle between the directions of two stations.
double turn_deg(const SurveyStation& a, const SurveyStation& b) {
    constexpr double degree = std::numbers::pi / 180;
    const auto direction = [&](const SurveyStation& station) {
        const double inclination = station.inclination_deg * degree;
        const double azimuth = station.azimuth_deg * degree;
        return Vec3{std::sin(inclination) * std::sin(azimuth), std::sin(inclination) * std::cos(azimuth),
                    -std::cos(inclination)};
    };
    const Vec3 u = direction(a);
    const Vec3 v = direction(b);
    return std::atan2(length(cross(u, v)), dot(u, v)) / degree;
}

/// A record of a log as it was read.
struct Logged {
    std::string hole;
    double from = 0;
    double to = 0;
    std::int64_t line = 0;
};

class Inspector {
  public:
    Inspector(const SiteInputs& inputs, Diagnostics& diagnostics) : inputs_(inputs), diagnostics_(diagnostics) {
        if (inputs_.source_crs.empty()) {
            inputs_.source_crs = "local";  // where on the globe does not matter here
        }
    }

    HoleQuality inspect() {
        HoleInputs read = read_hole_inputs(inputs_, said_);
        inspect_collars(read.collars);
        const Crs metric = parse_crs("local");
        std::vector<Crs> collar_crs;
        for (PlacedTable& placed : read.collars) {
            collar_crs.push_back(placed.crs);
            to_crs(placed, Crs(placed.crs), said_);  // where they are: only directions and heights are made ready
        }
        for (auto* tables : {&read.surveys, &read.logs}) {
            for (Table& table : *tables) {
                if (table.stated.hole_names.empty()) {
                    join_ids(table, read.collars, inputs_.columns, said_);
                }
                if (tables == &read.logs) {
                    split_ranges(table, inputs_.columns, said_);
                }
                take_stated_depth_unit(table, metric, inputs_, said_);
            }
        }
        SiteInputs grid = inputs_;
        grid.azimuth = AzimuthReference::grid;
        const Holes holes = read_boreholes(read.collars, collar_crs, read.surveys, read.paths, metric, grid, said_);
        for (const auto& [id, hole] : holes) {
            records_[id] = {id, hole.deepest, {}, {}, 0};
        }
        inspect_surveys(read, holes);
        for (Table& log : read.logs) {
            complete_bases(log, holes, metric, inputs_, said_);
            inspect_log(log, holes, metric);
        }
        take_rejections();
        inspect_lengths(holes);
        return result(read);
    }

  private:
    void find(HoleDefect defect, const std::string& hole, const std::string& file, std::int64_t line, double from,
              double to, std::string text) {
        findings_.push_back({defect, hole, file, line, from, to, std::move(text)});
    }

    void inspect_collars(const std::vector<PlacedTable>& tables) {
        std::map<std::string, std::int64_t> lines;
        std::map<std::tuple<double, double, double>, std::string> places;
        for (const PlacedTable& placed : tables) {
            const Table& table = placed.table;
            const int id_column = find_optional_column(table, Meaning::id, inputs_.columns);
            for (std::size_t row = 0; id_column >= 0 && row < table.rows(); ++row) {
                const std::string id(table.cells[static_cast<std::size_t>(id_column)][row]);
                if (id.empty() || !placed.usable(row)) {
                    continue;
                }
                const auto [known, added] = lines.emplace(id, table.lines[row]);
                if (!added) {
                    find(HoleDefect::duplicate_collar, id, table.file, table.lines[row], missing, missing,
                         fmt::format("its collar stands on line {} already", known->second));
                    continue;
                }
                const Vec3& p = placed.points[row];
                const auto [place, first] = places.emplace(std::tuple(p.x, p.y, p.z), id);
                if (!first) {
                    find(HoleDefect::duplicate_place, id, table.file, table.lines[row], missing, missing,
                         fmt::format("begins where {} does", place->second));
                }
            }
        }
    }

    void inspect_surveys(const HoleInputs& read, const Holes& holes) {
        std::set<std::string> surveyed;
        for (const Table& table : read.surveys) {
            const int id_column = find_optional_column(table, Meaning::id, inputs_.columns);
            const int depth_column = find_optional_column(table, Meaning::depth, inputs_.columns);
            std::map<std::pair<std::string, double>, std::int64_t> stations;
            for (std::size_t row = 0; row < table.rows(); ++row) {
                const std::string id(id_column < 0 ? std::string_view(table.stated.hole_names.front())
                                                   : table.cells[static_cast<std::size_t>(id_column)][row]);
                surveyed.insert(id);
                const auto depth = parse_number(table.cells[static_cast<std::size_t>(depth_column)][row]);
                if (!depth || !holes.contains(id)) {
                    continue;
                }
                const auto [known, added] = stations.emplace(std::pair(id, *depth), table.lines[row]);
                if (!added) {
                    find(HoleDefect::duplicate_station, id, table.file, table.lines[row], *depth, *depth,
                         fmt::format("a station at {} stands on line {} already", metres(*depth), known->second));
                }
            }
        }
        for (const HolePath& path : read.paths) {
            surveyed.insert(path.hole);
        }
        for (const auto& [id, hole] : holes) {
            HoleRecord& record = records_[id];
            record.stations = hole.path.stations();
            if (surveyed.contains(id)) {
                ++surveyed_;
            } else if (!read.surveys.empty() && hole.surveyed == 0 && vertical(record)) {
                find(HoleDefect::missing_survey, id, "", 0, missing, missing, "no station of any survey");
            }
            find_kinks(record);
        }
    }

    /// As a hole is taken where nothing is known.
    static bool vertical(const HoleRecord& record) {
        return record.stations.size() == 1 && record.stations.front().inclination_deg == 0;
    }

    void find_kinks(const HoleRecord& record) {
        for (std::size_t i = 0; i + 1 < record.stations.size(); ++i) {
            const SurveyStation& a = record.stations[i];
            const SurveyStation& b = record.stations[i + 1];
            const double turn = turn_deg(a, b);
            const double severity = turn / (b.depth - a.depth) * 30;
            if (severity > kink_deg_per_30m && turn > 1) {
                find(HoleDefect::kink, record.id, "", 0, a.depth, b.depth,
                     fmt::format("turns by {:.1f}° from {} to {} m: {:.0f}° in 30 m", turn, metres(a.depth),
                                 metres(b.depth), severity));
            }
        }
    }

    void inspect_log(const Table& table, const Holes& holes, const Crs& metric) {
        const int id_column = find_optional_column(table, Meaning::id, inputs_.columns);
        const int from_column = find_optional_column(table, Meaning::from, inputs_.columns);
        const int to_column = find_optional_column(table, Meaning::to, inputs_.columns);
        const bool intervals = from_column >= 0 && to_column >= 0;
        const int depth_column = intervals ? from_column : find_optional_column(table, Meaning::depth, inputs_.columns);
        if (depth_column < 0 || (id_column < 0 && table.stated.hole_names.empty())) {
            throw InputError(fmt::format("{}: no column for {}; columns: {}", table.file,
                                         depth_column < 0 ? "depths" : "the hole's id",
                                         fmt::join(table.columns, ", ")));
        }
        std::vector<Logged> rows;
        std::set<std::string> strangers;
        for (std::size_t row = 0; row < table.rows(); ++row) {
            const std::string id(id_column < 0 ? std::string_view(table.stated.hole_names.front())
                                               : table.cells[static_cast<std::size_t>(id_column)][row]);
            const auto hole = holes.find(id);
            if (hole == holes.end()) {
                if (strangers.insert(id).second) {
                    find(HoleDefect::without_collar, id, table.file, table.lines[row], missing, missing,
                         "no collar table has this hole");
                }
                continue;
            }
            take_row(table, row, id, intervals ? to_column : -1, depth_column,
                     depth_factor(table, hole->second.unit_factor, metric), rows);
        }
        std::ranges::stable_sort(rows, {},
                                 [](const Logged& logged) { return std::tie(logged.hole, logged.from, logged.to); });
        compare_rows(table, rows, intervals);
    }

    void take_row(const Table& table, std::size_t row, const std::string& id, int to_column, int from_column,
                  double factor, std::vector<Logged>& rows) {
        std::string problem;
        const double from = parse_depth(table, from_column, row, factor, 1, problem);
        const bool open = to_column >= 0 && !table.stated.meanings.empty() &&
                          table.cells[static_cast<std::size_t>(to_column)][row].empty();
        const double to =
            to_column < 0 || open || !problem.empty() ? from : parse_depth(table, to_column, row, factor, 1, problem);
        if (!problem.empty()) {
            find(HoleDefect::bad_record, id, table.file, table.lines[row], missing, missing, problem);
        } else if (from > to) {
            find(HoleDefect::turned_interval, id, table.file, table.lines[row], to, from,
                 fmt::format("from {} is below to {}", metres(from), metres(to)));
        } else {
            rows.push_back({id, from, to, table.lines[row]});
        }
    }

    void compare_rows(const Table& table, const std::vector<Logged>& rows, bool intervals) {
        const Logged* before = nullptr;
        for (const Logged& row : rows) {
            HoleRecord& record = records_[row.hole];
            record.logs[table.file].push_back({row.from, row.to});
            const bool same = before != nullptr && before->hole == row.hole;
            const double rounding = 1e-3 * (row.to - row.from) + 1e-6;
            if (same && row.from == before->from && row.to == before->to) {
                find(HoleDefect::duplicate_interval, row.hole, table.file, row.line, row.from, row.to,
                     fmt::format("{} to {} stands on line {} already", metres(row.from), metres(row.to), before->line));
            } else if (same && intervals && row.from < before->to - rounding) {
                find(HoleDefect::overlap, row.hole, table.file, row.line, row.from, std::min(row.to, before->to),
                     fmt::format("{} to {} overlaps {} to {} on line {}", metres(row.from), metres(row.to),
                                 metres(before->from), metres(before->to), before->line));
            } else if (same && intervals && row.from > before->to + rounding) {
                find(HoleDefect::gap, row.hole, table.file, row.line, before->to, row.from,
                     fmt::format("nothing from {} to {}", metres(before->to), metres(row.from)));
            }
            const bool deeper = before == nullptr || !same || row.to > before->to;
            before = deeper ? &row : before;
        }
    }

    /// What the readers of places and surveys refused; duplicates are told already.
    void take_rejections() {
        for (const Rejected& rejected : said_.rejected) {
            if (rejected.reason.find("a second") != std::string::npos) {
                continue;
            }
            const bool stranger = rejected.reason.ends_with("has no collar");
            const std::string hole = stranger ? rejected.reason.substr(5, rejected.reason.size() - 5 - 14) : "";
            if (!stranger || strangers_.insert(rejected.file + '\n' + hole).second) {
                find(stranger ? HoleDefect::without_collar : HoleDefect::bad_record, hole, rejected.file, rejected.line,
                     missing, missing, stranger ? "no collar table has this hole" : rejected.reason);
            }
        }
        diagnostics_.notes.insert(diagnostics_.notes.end(), said_.notes.begin(), said_.notes.end());
    }

    void inspect_lengths(const Holes& holes) {
        for (const auto& [id, hole] : holes) {
            HoleRecord& record = records_[id];
            double deepest = 0;
            std::string where;
            for (const auto& [file, intervals] : record.logs) {
                for (const LoggedInterval& interval : intervals) {
                    where = interval.to > deepest ? file : where;
                    deepest = std::max(deepest, interval.to);
                }
            }
            if (hole.deepest > 0 && deepest > hole.deepest * (1 + 1e-6) + 1e-6) {
                find(HoleDefect::beyond_length, id, where, 0, hole.deepest, deepest,
                     fmt::format("logged to {} m, the hole ends at {} m", metres(deepest), metres(hole.deepest)));
            }
            record.length_m = hole.deepest > 0 ? hole.deepest : std::max(deepest, hole.surveyed);
        }
    }

    HoleQuality result(const HoleInputs& read) {
        HoleQuality quality;
        for (auto& [id, record] : records_) {
            if (!record.logs.empty()) {
                ++quality.logged;
            } else if (!read.logs.empty()) {
                find(HoleDefect::without_log, id, "", 0, missing, missing, "no row of any log");
            }
        }
        const auto place = [](const HoleFinding& f) { return std::isnan(f.from) ? -1.0 : f.from; };
        std::ranges::stable_sort(findings_, {}, [&](const HoleFinding& f) {
            return std::tuple(std::string_view(f.hole), place(f), f.defect);
        });
        for (const HoleFinding& finding : findings_) {
            ++quality.counts[finding.defect];
            if (const auto record = records_.find(finding.hole); record != records_.end()) {
                ++record->second.findings;
            }
        }
        for (auto& [id, record] : records_) {
            quality.holes.push_back(std::move(record));
        }
        quality.findings = std::move(findings_);
        quality.surveyed = surveyed_;
        return quality;
    }

    SiteInputs inputs_;
    Diagnostics& diagnostics_;
    Diagnostics said_;
    std::map<std::string, HoleRecord> records_;
    std::vector<HoleFinding> findings_;
    std::set<std::string> strangers_;
    std::size_t surveyed_ = 0;
};

}  // namespace

const char* to_string(HoleDefect defect) {
    return names[static_cast<std::size_t>(defect)];
}

const HoleRecord* HoleQuality::worst() const {
    const auto found = std::ranges::max_element(holes, {}, &HoleRecord::findings);
    return found == holes.end() ? nullptr : &*found;
}

HoleQuality hole_quality(const SiteInputs& inputs, Diagnostics& diagnostics) {
    return Inspector(inputs, diagnostics).inspect();
}

}  // namespace terratet
