// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model/row_order.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "io/base/current_time.hpp"
#include "io/model/model_schema.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

using Order = std::vector<std::uint32_t>;

/// The list in another order, and where each element went.
template <typename T>
std::vector<T> ordered(std::vector<T>& list, const Order& order) {
    std::vector<T> result;
    for (const std::uint32_t i : order) {
        result.push_back(std::move(list[i]));
    }
    return result;
}

std::vector<std::int32_t> inverse(const Order& order) {
    std::vector<std::int32_t> rank(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        rank[order[i]] = static_cast<std::int32_t>(i);
    }
    return rank;
}

/// By the rows' numbers as listed.
Order order_by(const nlohmann::json& listed, const std::vector<std::int64_t>& numbers, const std::string& file) {
    Order order;
    for (const auto& row : listed) {
        const auto found = std::ranges::find(numbers, row.get<std::int64_t>());
        if (found == numbers.end() || order.size() == numbers.size()) {
            break;
        }
        order.push_back(static_cast<std::uint32_t>(found - numbers.begin()));
    }
    Order once = order;
    std::ranges::sort(once);
    if (order.size() != numbers.size() || std::ranges::adjacent_find(once) != once.end()) {
        throw InputError(file + ": layer " + schema::meta + ", key row_order does not name each row once");
    }
    return order;
}

}  // namespace

std::string row_order_text(const RowNumbers& numbers) {
    return nlohmann::json{{"surfaces", numbers.surfaces}, {"sheets", numbers.sheets}}.dump();
}

void put_in_order(const std::string& row_order, Model& model, RowNumbers& numbers, const std::string& file) {
    nlohmann::json listed;
    Order surfaces;
    Order sheets;
    try {
        listed = nlohmann::json::parse(row_order);
        surfaces = order_by(listed.at("surfaces"), numbers.surfaces, file);
        sheets = order_by(listed.at("sheets"), numbers.sheets, file);
    } catch (const nlohmann::json::exception& error) {
        throw InputError(file + ": layer " + schema::meta + ", key row_order is damaged: " + error.what());
    }
    model.surfaces = ordered(model.surfaces, surfaces);
    numbers.surfaces = ordered(numbers.surfaces, surfaces);
    model.barriers = ordered(model.barriers, sheets);
    numbers.sheets = ordered(numbers.sheets, sheets);

    Order holes(model.boreholes.size());
    std::iota(holes.begin(), holes.end(), 0);
    std::ranges::sort(holes, {}, [&](std::uint32_t i) { return model.boreholes[i].id; });
    model.boreholes = ordered(model.boreholes, holes);
    numbers.boreholes = ordered(numbers.boreholes, holes);
    const auto hole_rank = inverse(holes);
    for (std::int32_t& owner : model.samples.borehole) {
        owner = owner < 0 ? -1 : hole_rank[static_cast<std::size_t>(owner)];
    }
    const Order samples = canonical_order(model.samples);
    model.samples = selected(model.samples, samples);
    numbers.samples = ordered(numbers.samples, samples);
    const auto sample_rank = inverse(samples);
    const auto sheet_rank = inverse(sheets);
    for (Vertex& vertex : model.vertices) {
        if (vertex.role == Role::sample || vertex.role == Role::seed) {
            vertex.owner =
                (vertex.role == Role::sample ? sample_rank : sheet_rank)[static_cast<std::size_t>(vertex.owner)];
        }
    }
}

std::string stored_digest(SqliteDatabase& database) {
    const SqliteStatement digest =
        database.prepare("SELECT value FROM " + quoted_name(schema::meta) + " WHERE key = 'digest'");
    return database.step(digest) ? digest.text(0) : std::string();
}

void require_state(SqliteDatabase& database, const StoredState& state) {
    const SqliteStatement last = database.prepare("SELECT max(edit) FROM " + quoted_name(schema::journal));
    if (stored_digest(database) != state.digest || !database.step(last) || last.integer(0) != state.last_edit) {
        throw Error(database.file() +
                    ": somebody else has edited the model meanwhile; nothing was stored, open it again");
    }
}

void add_to_journal(SqliteDatabase& database, const JournalEntry& entry) {
    SqliteStatement insert = database.prepare("INSERT INTO " + quoted_name(schema::journal) +
                                              " (edit, time, command, arguments) VALUES (?, ?, ?, ?)");
    insert.bind(1, entry.edit);
    insert.bind(2, entry.time.empty() ? current_time_text() : entry.time);
    insert.bind(3, entry.command);
    insert.bind(4, entry.arguments);
    database.step(insert);
}

}  // namespace terratet
