// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/site/hole_names.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/read/join_ids.hpp"

namespace terratet {

void HoleNames::add(const Table& table, const ColumnNames& names) {
    const int id = find_optional_column(table, Meaning::id, names);
    if (id < 0) {
        return;
    }
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const std::string hole(table.cells[static_cast<std::size_t>(id)][row]);
        for (std::size_t column = 0; column < table.columns.size(); ++column) {
            const bool own = static_cast<int>(column) == id;
            const bool other = table.stated.meanings.empty() &&
                               std::ranges::find(aliases(Meaning::id), normal_header(table.columns[column])) !=
                                   aliases(Meaning::id).end();
            if (own || other) {
                const std::string name(table.cells[column][row]);
                enter(own ? ids_ : exact_, name, hole);
                enter(loose_, near_id(name), hole);
            }
        }
    }
}

void HoleNames::add_aliases(const std::vector<std::string>& names, const std::string& hole) {
    std::ranges::for_each(names, [&](const std::string& name) { enter(exact_, name, hole); });
}

std::string HoleNames::find(const std::vector<std::string>& names, const std::string& file,
                            Diagnostics& diagnostics) const {
    for (const auto* known : {&ids_, &exact_}) {
        for (const std::string& name : names) {
            const auto found = known->find(name);
            if (found != known->end() && !found->second.empty()) {
                return found->second;
            }
        }
    }
    for (const std::string& name : names) {
        const auto found = loose_.find(near_id(name));
        if (found != loose_.end() && !found->second.empty()) {
            diagnostics.note(fmt::format("{}: its hole '{}' is taken for {}", file, name, found->second));
            return found->second;
        }
    }
    return {};
}

void HoleNames::enter(Known& known, const std::string& name, const std::string& hole) {
    if (name.empty()) {
        return;
    }
    const auto [entry, added] = known.emplace(name, hole);
    if (!added && entry->second != hole) {
        entry->second.clear();  // of two holes: no name at all
    }
}

}  // namespace terratet
