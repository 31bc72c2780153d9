// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/read_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tess/error.hpp"

namespace terratet {

namespace {

struct LogColumns {
    int id = -1;
    int from = -1;
    int to = -1;  ///< −1: a point log, `from` is its depth
    [[nodiscard]] bool intervals() const { return to >= 0; }
};

/// A record of a log that has a place in a hole and a value.
struct LogRow {
    std::size_t row = 0;
    Hole* hole = nullptr;
    double from = 0;  ///< in the target's unit
    double to = 0;
};

LogColumns log_columns(const Table& table, const ColumnNames& names) {
    const bool one_hole = !table.stated.hole_names.empty();
    LogColumns columns{one_hole ? -1 : find_column(table, Meaning::id, names),
                       find_optional_column(table, Meaning::from, names),
                       find_optional_column(table, Meaning::to, names)};
    const bool no_id = columns.id < 0 && !one_hole;
    const bool intervals = columns.from >= 0 && columns.to >= 0;
    if (!intervals) {
        columns.from = find_column(table, Meaning::depth, names);
        columns.to = -1;
    }
    if (no_id || columns.from < 0) {
        throw InputError(fmt::format("{}: no column for {}; columns: {}; name {} with `columns`", table.file,
                                     no_id ? "the hole's id" : "depths, neither from and to nor depth",
                                     fmt::join(table.columns, ", "),
                                     no_id ? "one (id=NAME)" : "them (from=NAME, to=NAME or depth=NAME)"));
    }
    return columns;
}

/// Puts a row's values into a record.
void set_values(SampleRecord& record, const std::vector<ValueColumn>& columns, std::size_t row,
                std::size_t properties) {
    record.values.assign(properties, missing);
    for (const ValueColumn& column : columns) {
        record.values[column.property] = column.values[row];
        if (!column.censored.empty()) {
            record.censored.resize(properties, Censoring::none);
            record.censored[column.property] = column.censored[row];
        }
    }
}

bool has_value(const std::vector<ValueColumn>& columns, std::size_t row) {
    return std::ranges::any_of(columns, [&](const ValueColumn& column) { return !std::isnan(column.values[row]); });
}

/// Where a record lies in which hole, or why it lies nowhere.
LogRow locate(const Table& table, const LogColumns& columns, std::size_t row, Holes& holes, const Crs& target,
              std::string& problem) {
    LogRow result{row, nullptr, 0, 0};
    const std::string id(columns.id < 0 ? std::string_view(table.stated.hole_names.front())
                                        : table.cells[static_cast<std::size_t>(columns.id)][row]);
    const auto hole = holes.find(id);
    if (hole == holes.end()) {
        problem = id.empty() ? "no id" : fmt::format("hole {} has no collar", id);
        return result;
    }
    result.hole = &hole->second;
    const double factor = depth_factor(table, result.hole->unit_factor, target);
    const auto depth = [&](int column) {
        return parse_depth(table, column, row, factor, target.metres_per_unit, problem);
    };
    result.from = depth(columns.from);
    const bool point = !columns.intervals() || (!table.stated.meanings.empty() &&
                                                table.cells[static_cast<std::size_t>(columns.to)][row].empty());
    result.to = !point && problem.empty() ? depth(columns.to) : result.from;
    if (problem.empty() && result.from > result.to) {
        problem = fmt::format("from {} is below to {}", table.cells[static_cast<std::size_t>(columns.from)][row],
                              table.cells[static_cast<std::size_t>(columns.to)][row]);
    }
    return result;
}

/// Rejects intervals that begin above the end of an earlier one of the same hole, by more than rounding.
void reject_overlaps(const Table& table, std::vector<LogRow>& rows, Diagnostics& diagnostics) {
    std::ranges::stable_sort(rows, {}, [](const LogRow& row) { return std::tie(row.hole->id, row.from, row.to); });
    std::vector<LogRow> kept;
    std::vector<Rejected> overlaps;
    const LogRow* before = nullptr;  // the interval above
    for (const LogRow& row : rows) {
        const bool test = row.from == row.to && !table.stated.meanings.empty();  // at a depth, amidst intervals
        const bool same_hole = before != nullptr && before->hole == row.hole;
        const double rounding = 1e-3 * (row.to - row.from);
        const bool repeated = same_hole && row.from == before->from && row.to == before->to;
        if (!test && same_hole && (repeated || row.from < before->to - rounding)) {
            overlaps.push_back({table.file, table.lines[row.row],
                                fmt::format("hole {}: the interval overlaps the one on line {}, which counts",
                                            row.hole->id, table.lines[before->row])});
            continue;
        }
        kept.push_back(row);
        before = test ? before : &row;
    }
    std::ranges::sort(overlaps, {}, &Rejected::line);
    std::ranges::move(overlaps, std::back_inserter(diagnostics.rejected));
    rows = std::move(kept);
}

void note_empty_records(const Table& table, std::size_t count, Diagnostics& diagnostics) {
    if (count > 0) {
        diagnostics.note(fmt::format("{}: {} of {} records have no value in any property and are left out", table.file,
                                     count, table.rows()));
    }
}

}  // namespace

void read_log(const Table& table, Holes& holes, const Crs& target, const SiteInputs& inputs,
              PropertyCatalogue& catalogue, std::vector<SampleRecord>& samples, Diagnostics& diagnostics) {
    const std::size_t first_rejection = diagnostics.rejected.size();
    const LogColumns columns = log_columns(table, inputs.columns);
    const std::vector<ValueColumn> values = catalogue.read(table, inputs.columns, diagnostics);
    std::vector<LogRow> rows;
    std::size_t empty = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        std::string problem;
        const LogRow located = locate(table, columns, row, holes, target, problem);
        if (!problem.empty()) {
            diagnostics.reject(table.file, table.lines[row], problem);
            continue;
        }
        located.hole->deepest = std::max(located.hole->deepest, located.to);
        if (has_value(values, row)) {
            rows.push_back(located);
        } else {
            ++empty;
        }
    }
    if (columns.intervals()) {
        reject_overlaps(table, rows, diagnostics);
    }
    if (rows.empty() && !values.empty() && !table.stated.one_of_several) {
        throw_no_usable_row(table, diagnostics, first_rejection);
    }
    note_empty_records(table, empty, diagnostics);
    for (const LogRow& row : rows) {
        const double depth = row.from + (row.to - row.from) / 2;
        samples.push_back({row.hole->path.position(depth), row.hole->id, depth, row.to - row.from, {}});
        set_values(samples.back(), values, row.row, catalogue.properties().size());
    }
}

void read_loose_samples(const PlacedTable& placed, const SiteInputs& inputs, PropertyCatalogue& catalogue,
                        std::vector<SampleRecord>& samples, Diagnostics& diagnostics) {
    const std::size_t first_rejection = diagnostics.rejected.size();
    const std::vector<ValueColumn> values = catalogue.read(placed.table, inputs.columns, diagnostics);
    const std::size_t before = samples.size();
    std::size_t empty = 0;
    for (std::size_t row = 0; row < placed.table.rows(); ++row) {
        if (!placed.usable(row)) {
            continue;  // rejected when its position was read
        }
        if (!has_value(values, row)) {
            ++empty;
            continue;
        }
        samples.push_back({placed.points[row], "", missing, 0, {}});
        set_values(samples.back(), values, row, catalogue.properties().size());
    }
    if (samples.size() == before && !values.empty()) {
        throw_no_usable_row(placed.table, diagnostics, first_rejection);
    }
    note_empty_records(placed.table, empty, diagnostics);
}

}  // namespace terratet
