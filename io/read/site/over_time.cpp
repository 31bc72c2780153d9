// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/site/over_time.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/base/time_steps.hpp"
#include "io/read/tables/pivot_times.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr std::size_t most_times = 1000;

}  // namespace

std::string take_time_column(SiteInputs& inputs) {
    const auto found = std::ranges::find(inputs.columns, "time", [](const auto& named) { return named.first; });
    if (found == inputs.columns.end()) {
        return {};
    }
    std::string column = found->second;
    inputs.columns.erase(found);
    return column;
}

void spread_over_time(const std::string& column, std::vector<Table>& logs, std::vector<PlacedTable>& samples,
                      SiteInputs& inputs, Diagnostics& diagnostics) {
    const std::vector<std::string> wanted = inputs.properties;
    std::vector<std::string> times;
    const auto collect = [&](const Table& table) {
        const auto more = times_in(table, column);
        times.insert(times.end(), more.begin(), more.end());
    };
    std::ranges::for_each(logs, collect);
    for (const PlacedTable& placed : samples) {
        collect(placed.table);
    }
    std::ranges::sort(times, time_before);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    if (times.empty()) {
        throw UsageError(
            fmt::format("`columns` time={}: no log and no table of samples has such a column with a time", column));
    }
    if (times.size() > most_times) {
        throw UsageError(fmt::format("`columns` time={}: {} times, {} to {}, each would be a property; at most {}",
                                     column, times.size(), times.front(), times.back(), most_times));
    }
    for (Table& table : logs) {
        if (column_named(table, column) >= 0) {
            inputs.properties = properties_over_time(inputs.properties, table, times);
            pivot_times(table, column, times, inputs.columns, wanted, diagnostics);
        }
    }
    for (PlacedTable& placed : samples) {
        if (column_named(placed.table, column) >= 0) {
            inputs.properties = properties_over_time(inputs.properties, placed.table, times);
            const auto rows = pivot_times(placed.table, column, times, inputs.columns, wanted, diagnostics);
            std::vector<Vec3> points;
            for (const std::size_t row : rows) {
                points.push_back(placed.points[row]);
            }
            placed.points = std::move(points);
        }
    }
    diagnostics.note(fmt::format("{} times, {} to {}: one tessellation, a property at the time T is called P@T",
                                 times.size(), times.front(), times.back()));
}

}  // namespace terratet
