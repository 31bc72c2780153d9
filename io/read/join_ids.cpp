// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/join_ids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "io/base/lower_case.hpp"

namespace terratet {
namespace {

/// The columns that may hold ids: the one named, else all that go by a usual name, by precedence.
std::vector<int> id_columns(const Table& table, const ColumnNames& names) {
    const int chosen = find_optional_column(table, Meaning::id, names);
    std::vector<int> result;
    if (chosen < 0) {
        return result;
    }
    result.push_back(chosen);
    const bool named = std::ranges::any_of(names, [&](const auto& entry) {
        return entry.first == to_string(Meaning::id) && column_named(table, entry.second) == chosen;
    });
    for (const std::string& alias : aliases(Meaning::id)) {
        for (std::size_t column = 0; column < table.columns.size() && !named; ++column) {
            if (static_cast<int>(column) != chosen && normal_header(table.columns[column]) == alias) {
                result.push_back(static_cast<int>(column));
            }
        }
    }
    return result;
}

const TextColumn& cells(const Table& table, int column) {
    return table.cells[static_cast<std::size_t>(column)];
}

/// Different ids, in order.
std::set<std::string, std::less<>> distinct(const TextColumn& column) {
    std::set<std::string, std::less<>> result;
    std::string_view last;
    for (const std::string_view id : column) {
        if (!id.empty() && id != last && !result.contains(id)) {
            result.emplace(id);
        }
        last = id;
    }
    return result;
}

/// What another column of the collars calls holes: to the id they go by.
using Names = std::map<std::string, std::string, std::less<>>;

/// Collars by one of their columns, called by its header; the first in the file counts.
struct Key {
    std::string header;
    Names names;
};

std::vector<Key> keys_of(const std::vector<PlacedTable>& collars, const ColumnNames& names) {
    std::vector<Key> keys;
    for (const PlacedTable& placed : collars) {
        const std::vector<int> columns = id_columns(placed.table, names);
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const std::string& header = placed.table.columns[static_cast<std::size_t>(columns[k])];
            const std::string known = k == 0 ? "" : header;  // own ids of all tables are one key
            auto key = std::ranges::find(keys, known, &Key::header);
            if (key == keys.end()) {
                keys.push_back({known, {}});
                key = keys.end() - 1;
            }
            for (std::size_t row = 0; row < placed.table.rows(); ++row) {
                const std::string_view name = cells(placed.table, columns[k])[row];
                const std::string_view own = cells(placed.table, columns[0])[row];
                if (!name.empty() && !own.empty()) {
                    key->names.emplace(name, own);
                }
            }
        }
    }
    return keys;
}

/// Which column of a table goes with which of the collars'.
struct Join {
    int column = -1;
    const Key* key = nullptr;
    std::size_t exact = 0;
    std::size_t near = 0;
};

Join best_join(const Table& table, const std::vector<int>& columns, const std::vector<Key>& keys) {
    Join best;
    for (const int column : columns) {
        const auto ids = distinct(cells(table, column));
        if (column != columns.front() && 2 * best.near >= distinct(cells(table, columns.front())).size()) {
            break;
        }
        for (const Key& key : keys) {
            std::set<std::string> nearly;
            for (const auto& [name, own] : key.names) {
                nearly.insert(near_id(name));
            }
            Join join{column, &key, 0, 0};
            for (const std::string& id : ids) {
                join.exact += key.names.contains(id) ? 1 : 0;
                join.near += nearly.contains(near_id(id)) ? 1 : 0;
            }
            if (best.key == nullptr || std::pair(join.near, join.exact) > std::pair(best.near, best.exact)) {
                best = join;
            }
            if (2 * best.near >= ids.size()) {
                break;  // running numbers under another name may have more in common, by chance
            }
        }
    }
    return best;
}

/// Ids of the table that are no collar's, to the only collar they can mean.
Names near_matches(const Table& table, const Join& join, Diagnostics& diagnostics) {
    std::map<std::string, std::vector<std::string>> collars;
    for (const auto& [name, own] : join.key->names) {
        collars[near_id(name)].push_back(name);
    }
    const auto ids = distinct(cells(table, join.column));
    std::map<std::string, std::vector<std::string>> own;
    for (const std::string& id : ids) {
        own[near_id(id)].push_back(id);
    }
    Names found;
    std::string taken;
    std::string unclear;
    std::size_t unclear_ids = 0;
    for (const auto& [form, members] : own) {
        const auto collar = collars.find(form);
        if (collar == collars.end() || form.empty()) {
            continue;
        }
        const bool clear = collar->second.size() == 1 && members.size() == 1;
        for (const std::string& id : members) {
            if (join.key->names.contains(id)) {
                continue;
            }
            if (clear) {
                found.emplace(id, collar->second.front());
                taken += found.size() > 5
                             ? ""
                             : fmt::format("{}'{}' for '{}'", taken.empty() ? "" : ", ", id, collar->second.front());
                continue;
            }
            unclear += ++unclear_ids > 5 ? ""
                                         : fmt::format("{}'{}' ('{}'?)", unclear.empty() ? "" : ", ", id,
                                                       fmt::join(collar->second, "' or '"));
        }
    }
    if (!found.empty()) {
        diagnostics.note(
            fmt::format("{}: {} ids are no collar's, but one collar alone is like each, which is taken: {}{}",
                        table.file, found.size(), taken, found.size() > 5 ? ", …" : ""));
    }
    if (unclear_ids > 0) {
        diagnostics.note(
            fmt::format("{}: {} ids are like collars', but it is not clear whose they are: {}{}; make them "
                        "alike in the tables",
                        table.file, unclear_ids, unclear, unclear_ids > 5 ? ", …" : ""));
    }
    return found;
}

}  // namespace

std::string near_id(std::string_view id) {
    std::string form;
    for (const char c : lower_case(id)) {
        if (c != ' ' && c != '\t' && c != '-' && c != '_') {
            form += c;
        }
    }
    if (const std::size_t point = form.find('.'); point != std::string::npos && point > 0 &&
                                                  form.find_first_not_of("0", point + 1) == std::string::npos &&
                                                  form.find_first_not_of("0123456789") == point) {
        form.resize(point);
    }
    std::string result;
    for (std::size_t i = 0; i < form.size(); ++i) {
        const auto digit = [&](std::size_t k) { return k < form.size() && form[k] >= '0' && form[k] <= '9'; };
        const bool leads =
            form[i] == '0' && digit(i + 1) && (result.empty() || result.back() < '0' || result.back() > '9');
        result += leads ? "" : std::string(1, form[i]);
    }
    return result;
}

void join_ids(Table& table, const std::vector<PlacedTable>& collars, const ColumnNames& columns,
              Diagnostics& diagnostics) {
    const std::vector<int> own = id_columns(table, columns);
    if (own.empty()) {
        return;
    }
    const std::vector<Key> keys = keys_of(collars, columns);
    const Join join = best_join(table, own, keys);
    if (join.key == nullptr || join.near == 0) {
        return;
    }
    const Names near = near_matches(table, join, diagnostics);
    const bool usual = join.column == own.front() && join.key->header.empty();
    if (!usual) {
        diagnostics.note(fmt::format("{}: its column {} is joined with the collars' {}, which have {} holes in common",
                                     table.file, table.columns[static_cast<std::size_t>(join.column)],
                                     join.key->header.empty() ? "own ids" : "column " + join.key->header,
                                     std::max(join.exact, join.near)));
    } else if (near.empty()) {
        return;
    }
    TextColumn ids;
    for (const std::string_view id : cells(table, join.column)) {
        const auto like = near.find(id);
        const auto name = join.key->names.find(like == near.end() ? id : std::string_view(like->second));
        ids.push_back(name == join.key->names.end() ? id : std::string_view(name->second));
    }
    table.cells[static_cast<std::size_t>(own.front())] = std::move(ids);
}

}  // namespace terratet
