// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/tables/pivot_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>

#include "io/base/lower_case.hpp"
#include "io/base/rejections.hpp"
#include "io/base/time_steps.hpp"

namespace terratet {
namespace {

/// "Cu (%)" at a time; where Cu is what was asked for, its unit stays behind.
std::string header_at(const std::string& header, const std::string& time, const std::vector<std::string>& wanted) {
    const std::size_t open = header.find_first_of("([");
    if (open == std::string::npos || open == 0 || header.find_last_of(")]") != header.size() - 1) {
        return name_at(header, time);
    }
    const std::size_t end = header.find_last_not_of(" \t", open - 1);
    const std::string name = header.substr(0, end == std::string::npos ? 0 : end + 1);
    const auto asks = [&](const std::string& property) {
        return lower_case(property.substr(0, property.find(':'))) == lower_case(name);
    };
    return std::ranges::any_of(wanted, asks) ? name_at(name, time) + " " + header.substr(open) : name_at(header, time);
}

/// Columns that say where a row is.
std::vector<bool> place_columns(const Table& table, const ColumnNames& names) {
    std::vector<bool> result(table.columns.size(), false);
    for (const Meaning meaning : {Meaning::id, Meaning::x, Meaning::y, Meaning::z, Meaning::from, Meaning::to,
                                  Meaning::depth, Meaning::azimuth, Meaning::dip, Meaning::length}) {
        if (const int column = find_optional_column(table, meaning, names); column >= 0) {
            result[static_cast<std::size_t>(column)] = true;
        }
    }
    return result;
}

class Pivot {
  public:
    Pivot(const Table& table, std::size_t time, const std::vector<std::string>& times, const ColumnNames& names,
          const std::vector<std::string>& wanted)
        : table_(table), time_(time), times_(times), wanted_(wanted), is_place_(place_columns(table, names)) {
        for (std::size_t t = 0; t < times.size(); ++t) {
            step_of_.emplace(times[t], t);
        }
    }

    std::vector<std::size_t> group(Diagnostics& diagnostics) {
        Rejections rejections(diagnostics, table_.file);
        std::map<std::string, std::size_t> group_of;
        std::vector<std::size_t> first;
        for (std::size_t row = 0; row < table_.rows(); ++row) {
            const auto step = step_of_.find(time_label(table_.cells[time_][row]));
            if (step == step_of_.end()) {
                rejections.add(table_.lines[row], [&] { return "no time in column " + table_.columns[time_]; });
                continue;
            }
            const auto [entry, fresh] = group_of.try_emplace(place_key(row), first.size());
            if (fresh) {
                first.push_back(row);
                rows_.emplace_back(times_.size(), none);
            }
            std::size_t& taken = rows_[entry->second][step->second];
            if (taken == none) {
                taken = row;
            } else {
                rejections.add(table_.lines[row], [&] {
                    return fmt::format("its place and time are those of line {}, which counts", table_.lines[taken]);
                });
            }
        }
        return first;
    }

    Table table(const std::vector<std::size_t>& first) const {
        Table result;
        result.file = table_.file;
        result.crs = table_.crs;
        result.notes = table_.notes;
        result.stated = table_.stated;
        result.stated.units.clear();
        std::vector<int> moved(table_.columns.size(), -1);
        for (const std::size_t row : first) {
            result.lines.push_back(table_.lines[row]);
            if (!table_.points.empty()) {
                result.points.push_back(table_.points[row]);
            }
        }
        for (std::size_t c = 0; c < table_.columns.size(); ++c) {
            if (c == time_) {
                continue;
            }
            moved[c] = static_cast<int>(result.columns.size());
            const auto add = [&](std::string header, const auto& row_of) {
                result.columns.push_back(std::move(header));
                TextColumn& cells = result.cells.emplace_back();
                for (std::size_t g = 0; g < first.size(); ++g) {
                    const std::size_t row = row_of(g);
                    cells.push_back(row == none ? std::string_view() : table_.cells[c][row]);
                }
                if (!table_.stated.units.empty()) {
                    result.stated.units.push_back(table_.stated.units[c]);
                }
            };
            if (is_place_[c]) {
                add(table_.columns[c], [&](std::size_t g) { return first[g]; });
                continue;
            }
            for (std::size_t t = 0; t < times_.size(); ++t) {
                add(header_at(table_.columns[c], times_[t], wanted_), [&](std::size_t g) { return rows_[g][t]; });
            }
        }
        for (auto& [meaning, column] : result.stated.meanings) {
            column = moved[static_cast<std::size_t>(column)];
        }
        for (int& column : result.stated.asides) {
            column = std::max(moved[static_cast<std::size_t>(column)], 0);
        }
        return result;
    }

  private:
    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    [[nodiscard]] std::string place_key(std::size_t row) const {
        std::string key;
        for (std::size_t c = 0; c < is_place_.size(); ++c) {
            if (is_place_[c]) {
                key.append(table_.cells[c][row]).push_back('\x1f');
            }
        }
        if (!table_.points.empty() && table_.points[row]) {
            const Vec3& p = *table_.points[row];
            key += fmt::format("{} {} {}", p.x, p.y, p.z);
        }
        return key;
    }

    const Table& table_;
    std::size_t time_;
    const std::vector<std::string>& times_;
    const std::vector<std::string>& wanted_;
    std::vector<bool> is_place_;
    std::unordered_map<std::string, std::size_t> step_of_;
    std::vector<std::vector<std::size_t>> rows_;  ///< by place and time
};

}  // namespace

std::vector<std::string> times_in(const Table& table, const std::string& column) {
    std::vector<std::string> times;
    if (const int found = column_named(table, column); found >= 0) {
        for (const std::string_view cell : table.cells[static_cast<std::size_t>(found)]) {
            std::string label = time_label(cell);
            if (!label.empty() && (times.empty() || times.back() != label)) {
                times.push_back(std::move(label));
            }
        }
    }
    std::ranges::sort(times, time_before);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

std::vector<std::size_t> pivot_times(Table& table, const std::string& column, const std::vector<std::string>& times,
                                     const ColumnNames& names, const std::vector<std::string>& wanted,
                                     Diagnostics& diagnostics) {
    Pivot pivot(table, static_cast<std::size_t>(column_named(table, column)), times, names, wanted);
    std::vector<std::size_t> first = pivot.group(diagnostics);
    table = pivot.table(first);
    return first;
}

std::vector<std::string> properties_over_time(const std::vector<std::string>& wanted, const Table& table,
                                              const std::vector<std::string>& times) {
    std::vector<std::string> result;
    for (const std::string& property : wanted) {
        const std::size_t end = std::min(property.find(':'), property.size());
        const std::string name = property.substr(0, end);
        const bool over_time = std::ranges::any_of(table.columns, [&](const std::string& header) {
            const std::string lower = lower_case(header);
            return lower == lower_case(name) || normal_header(header) == normal_header(name);
        });
        if (!over_time) {
            result.push_back(property);
            continue;
        }
        for (const std::string& time : times) {
            result.push_back(name_at(name, time) + property.substr(end));
        }
    }
    return result;
}

}  // namespace terratet
