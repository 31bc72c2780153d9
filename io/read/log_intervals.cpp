// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/log_intervals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "io/base/text_lines.hpp"
#include "io/read/tables/header_units.hpp"

namespace terratet {
namespace {

using Texts = std::pair<std::string, std::string>;

/// Both ends of a range as they are written.
std::optional<Texts> range_of(std::string_view text) {
    static constexpr std::array<std::string_view, 6> between{" to ", "–", "—", "..", "-", ":"};
    static constexpr std::array<std::string_view, 2> units{"m", "ft"};
    text = trimmed(text);
    for (const std::string_view unit : units) {
        if (text.ends_with(unit)) {
            text.remove_suffix(unit.size());
            text = trimmed(text);
        }
    }
    for (const std::string_view sign : between) {
        const std::size_t at = text.find(sign, 1);
        if (at == std::string_view::npos) {
            continue;
        }
        const std::string_view from = trimmed(text.substr(0, at));
        const std::string_view to = trimmed(text.substr(at + sign.size()));
        const auto first = parse_number(from);
        const auto second = parse_number(to);
        if (first && second && *first <= *second) {
            return Texts{from, to};
        }
    }
    return std::nullopt;
}

bool may_hold_ranges(const std::string& header) {
    static constexpr std::array<std::string_view, 12> names{
        "interval", "depthinterval", "sampleinterval", "intervaldepth", "range",  "depthrange",
        "fromto",   "depthfromto",   "depth",          "from",          "depths", "teufe"};
    return std::ranges::find(names, normal_header(header)) != names.end();
}

bool holds_ranges(const TextColumn& cells) {
    std::size_t filled = 0;
    std::size_t ranges = 0;
    for (const std::string_view cell : cells) {
        filled += cell.empty() ? 0 : 1;
        ranges += range_of(cell) ? 1 : 0;
    }
    return ranges > 0 && 10 * ranges >= 9 * filled;
}

/// Column of text, row by row.
TextColumn column_of(const std::vector<std::string>& texts) {
    TextColumn result;
    for (const std::string& text : texts) {
        result.push_back(text);
    }
    return result;
}

std::string_view hole_of(const Table& log, int id_column, std::size_t row) {
    return id_column < 0 ? std::string_view(log.stated.hole_names.front())
                         : log.cells[static_cast<std::size_t>(id_column)][row];
}

}  // namespace

void split_ranges(Table& log, const ColumnNames& columns, Diagnostics& diagnostics) {
    if (!log.stated.meanings.empty() || (find_optional_column(log, Meaning::from, columns) >= 0 &&
                                         find_optional_column(log, Meaning::to, columns) >= 0)) {
        return;
    }
    for (std::size_t column = 0; column < log.columns.size(); ++column) {
        if (!may_hold_ranges(log.columns[column]) || !holds_ranges(log.cells[column])) {
            continue;
        }
        std::vector<std::string> tops;
        std::vector<std::string> bases;
        for (const std::string_view cell : log.cells[column]) {
            const auto range = range_of(cell);
            tops.emplace_back(range ? range->first : cell);
            bases.emplace_back(range ? range->second : cell);
        }
        diagnostics.note(fmt::format("{}: column {} holds ranges: from and to", log.file, log.columns[column]));
        const auto unit = stated_length_unit(log, static_cast<int>(column));
        const std::string suffix = unit ? " [" + unit->text + "]" : "";
        log.columns[column] = "from" + suffix;
        log.cells[column] = column_of(tops);
        log.columns.push_back("to" + suffix);
        log.cells.push_back(column_of(bases));
        if (!log.stated.units.empty()) {
            log.stated.units.push_back(log.stated.units[column]);
        }
        return;
    }
}

void complete_bases(Table& log, const Holes& holes, const Crs& target, const SiteInputs& inputs,
                    Diagnostics& diagnostics) {
    const int id = log.stated.hole_names.empty() ? find_optional_column(log, Meaning::id, inputs.columns) : -1;
    const int from = find_optional_column(log, Meaning::from, inputs.columns);
    if (!log.stated.meanings.empty() || from < 0 || (id < 0 && log.stated.hole_names.empty()) ||
        find_optional_column(log, Meaning::to, inputs.columns) >= 0 ||
        find_optional_column(log, Meaning::depth, inputs.columns) >= 0) {
        return;
    }
    const TextColumn& tops = log.cells[static_cast<std::size_t>(from)];
    std::map<std::string_view, std::map<double, std::string_view>> of_hole;
    for (std::size_t row = 0; row < log.rows(); ++row) {
        if (const auto top = parse_number(tops[row])) {
            of_hole[hole_of(log, id, row)].emplace(*top, tops[row]);
        }
    }
    std::vector<std::string> bases(log.rows());
    std::size_t endless = 0;
    for (std::size_t row = 0; row < log.rows(); ++row) {
        const std::string_view name = hole_of(log, id, row);
        const auto hole = holes.find(name);
        const auto top = parse_number(tops[row]);
        if (!top || hole == holes.end()) {
            continue;
        }
        const auto& all = of_hole[name];
        if (const auto next = all.upper_bound(*top); next != all.end()) {
            bases[row] = next->second;
            continue;
        }
        const double end = hole->second.end() / depth_factor(log, hole->second.unit_factor, target);
        if (end > *top) {
            bases[row] = fmt::format("{}", end);
        } else {
            ++endless;
        }
    }
    diagnostics.note(
        fmt::format("{}: column {} has no base beside it: each row reaches to the next of its hole, the "
                    "last to the hole's end{}",
                    log.file, log.columns[static_cast<std::size_t>(from)],
                    endless == 0 ? ""
                                 : fmt::format("; of {} holes nobody says where that is below their last "
                                               "top: a length in the collar table would",
                                               endless)));
    const auto unit = stated_length_unit(log, from);
    log.columns.push_back(unit ? "to [" + unit->text + "]" : "to");
    log.cells.push_back(column_of(bases));
    if (!log.stated.units.empty()) {
        log.stated.units.push_back(log.stated.units[static_cast<std::size_t>(from)]);
    }
}

}  // namespace terratet
