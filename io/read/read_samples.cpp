// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/read_samples.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "io/base/free_memory.hpp"
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
    std::uint32_t row = 0;
    Hole* hole = nullptr;
    double from = 0;  ///< in the target's unit
    double to = 0;
};

/// Holes by id; rows of one hole mostly follow each other.
class HoleFinder {
  public:
    explicit HoleFinder(Holes& holes) : holes_(holes) {}

    /// nullptr: no such hole.
    Hole* find(std::string_view id) {
        if (last_ == nullptr || last_->id != id) {
            const auto found = holes_.find(id);
            last_ = found == holes_.end() ? nullptr : &found->second;
        }
        return last_;
    }

  private:
    Holes& holes_;
    Hole* last_ = nullptr;
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

/// Which rows have a value.
std::vector<bool> filled_rows(const std::vector<ValueColumn>& columns, std::size_t rows) {
    std::vector<bool> result(rows, false);
    for (const ValueColumn& column : columns) {
        for (std::size_t row = 0; row < rows; ++row) {
            if (!std::isnan(column.values[row])) {
                result[row] = true;
            }
        }
    }
    return result;
}

/// Appends the values of the rows to the samples, which have their places already; each column is given up then. Where
/// a table is all there is, its columns become the samples'.
template <typename Rows, typename RowOf>
void append_values(std::vector<ValueColumn>& columns, const Rows& rows, std::size_t properties, Samples& samples,
                   const RowOf& row_of) {
    const std::size_t before = samples.size() - rows.size();
    const bool whole = before == 0 && !columns.empty() && columns.front().values.size() == rows.size() &&
                       std::ranges::is_sorted(rows, {}, row_of);
    samples.values.resize(properties);
    for (std::vector<double>& column : samples.values) {
        column.resize(before, missing);
    }
    samples.censored.resize(samples.censored.empty() ? 0 : properties);
    for (std::vector<Censoring>& column : samples.censored) {
        column.resize(samples.size(), Censoring::none);
    }
    for (ValueColumn& column : columns) {
        std::vector<double>& values = samples.values[column.property];
        if (whole) {
            values = std::move(column.values);
        } else {
            values.reserve(before == 0 ? rows.size() : 0);
            for (const auto& row : rows) {
                values.push_back(column.values[row_of(row)]);
            }
        }
        for (std::size_t i = 0; i < rows.size() && !column.censored.empty(); ++i) {
            samples.set_censoring(column.property, before + i, column.censored[row_of(rows[i])]);
        }
        column = {};
    }
    for (std::vector<double>& column : samples.values) {
        column.resize(samples.size(), missing);
    }
}

/// Where a record lies in which hole, or why it lies nowhere.
LogRow locate(const Table& table, const LogColumns& columns, std::size_t row, HoleFinder& holes, const Crs& target,
              std::string& problem) {
    const std::string_view id = columns.id < 0 ? std::string_view(table.stated.hole_names.front())
                                               : table.cells[static_cast<std::size_t>(columns.id)][row];
    LogRow result{static_cast<std::uint32_t>(row), holes.find(id), 0, 0};
    if (result.hole == nullptr) {
        problem = id.empty() ? "no id" : fmt::format("hole {} has no collar", id);
        return result;
    }
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
    const auto place = [](const LogRow& row) { return std::tie(row.hole->index, row.from, row.to, row.row); };
    if (!std::ranges::is_sorted(rows, {}, place)) {
        std::ranges::sort(rows, {}, place);
    }
    std::vector<Rejected> overlaps;
    std::size_t kept = 0;
    LogRow before;  // the interval above
    for (const LogRow& row : rows) {
        const bool test = row.from == row.to && !table.stated.meanings.empty();  // at a depth, amidst intervals
        const bool same_hole = kept > 0 && before.hole == row.hole;
        const double rounding = 1e-3 * (row.to - row.from);
        const bool repeated = same_hole && row.from == before.from && row.to == before.to;
        if (!test && same_hole && (repeated || row.from < before.to - rounding)) {
            overlaps.push_back({table.file, table.lines[row.row],
                                fmt::format("hole {}: the interval overlaps the one on line {}, which counts",
                                            row.hole->id, table.lines[before.row])});
            continue;
        }
        before = test ? before : row;
        rows[kept++] = row;
    }
    rows.resize(kept);
    std::ranges::sort(overlaps, {}, &Rejected::line);
    std::ranges::move(overlaps, std::back_inserter(diagnostics.rejected));
}

void note_empty_records(const Table& table, std::size_t count, Diagnostics& diagnostics) {
    if (count > 0) {
        diagnostics.note(fmt::format("{}: {} of {} records have no value in any property and are left out", table.file,
                                     count, table.rows()));
    }
}

/// Of the first table, which may be the only big one; later ones grow what there is.
void reserve_places(Samples& samples, std::size_t count) {
    const std::size_t room = samples.size() == 0 ? count : 0;
    samples.positions.reserve(room);
    samples.borehole.reserve(room);
    samples.depth.reserve(room);
    samples.length.reserve(room);
}

void give_up_text(Table& table) {
    table.cells.assign(table.columns.size(), {});
    give_back_memory();
}

}  // namespace

void read_log(Table& table, Holes& holes, const Crs& target, const SiteInputs& inputs, PropertyCatalogue& catalogue,
              Samples& samples, Diagnostics& diagnostics) {
    const std::size_t first_rejection = diagnostics.rejected.size();
    const LogColumns columns = log_columns(table, inputs.columns);
    std::vector<ValueColumn> values = catalogue.read(table, inputs.columns, diagnostics);
    const std::vector<bool> filled = filled_rows(values, table.rows());
    HoleFinder finder(holes);
    std::vector<LogRow> rows;
    rows.reserve(table.rows());
    std::size_t empty = 0;
    for (std::size_t row = 0; row < table.rows(); ++row) {
        std::string problem;
        const LogRow located = locate(table, columns, row, finder, target, problem);
        if (!problem.empty()) {
            diagnostics.reject(table.file, table.lines[row], problem);
            continue;
        }
        located.hole->deepest = std::max(located.hole->deepest, located.to);
        if (filled[row]) {
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
    give_up_text(table);
    reserve_places(samples, rows.size());
    for (const LogRow& row : rows) {
        const double depth = row.from + (row.to - row.from) / 2;
        samples.positions.push_back(row.hole->path.position(depth));
        samples.borehole.push_back(row.hole->index);
        samples.depth.push_back(depth);
        samples.length.push_back(row.to - row.from);
    }
    append_values(values, rows, catalogue.properties().size(), samples,
                  [](const LogRow& row) { return std::size_t{row.row}; });
}

void read_loose_samples(PlacedTable& placed, const SiteInputs& inputs, PropertyCatalogue& catalogue, Samples& samples,
                        Diagnostics& diagnostics) {
    const std::size_t first_rejection = diagnostics.rejected.size();
    std::vector<ValueColumn> values = catalogue.read(placed.table, inputs.columns, diagnostics);
    const std::vector<bool> filled = filled_rows(values, placed.table.rows());
    std::vector<std::uint32_t> rows;
    std::size_t empty = 0;
    for (std::size_t row = 0; row < placed.table.rows(); ++row) {
        const bool usable = placed.usable(row);  // else rejected when its position was read
        if (usable && filled[row]) {
            rows.push_back(static_cast<std::uint32_t>(row));
        }
        empty += usable && !filled[row] ? 1 : 0;
    }
    if (rows.empty() && !values.empty()) {
        throw_no_usable_row(placed.table, diagnostics, first_rejection);
    }
    note_empty_records(placed.table, empty, diagnostics);
    give_up_text(placed.table);
    const std::size_t size = samples.size() + rows.size();
    reserve_places(samples, rows.size());
    for (const std::uint32_t row : rows) {
        samples.positions.push_back(placed.points[row]);
    }
    placed.points = {};
    samples.borehole.resize(size, -1);
    samples.depth.resize(size, missing);
    samples.length.resize(size, 0);
    append_values(values, rows, catalogue.properties().size(), samples,
                  [](std::uint32_t row) { return std::size_t{row}; });
}

}  // namespace terratet
