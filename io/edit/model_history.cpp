// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "io/edit/stored_rows.hpp"
#include "io/model/model_schema.hpp"
#include "io/model/opened_model.hpp"
#include "io/model/row_order.hpp"
#include "io/model_store.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr const char* undo = "undo";
constexpr const char* redo = "redo";

/// Which edit an undo or redo is of.
std::int64_t of_edit(const JournalEntry& entry) {
    const auto arguments = nlohmann::json::parse(entry.arguments, nullptr, false);
    return arguments.is_object() && arguments.contains("edit") && arguments["edit"].is_number_integer()
               ? arguments["edit"].get<std::int64_t>()
               : -1;
}

bool is_step(const JournalEntry& entry) {
    return entry.command == undo || entry.command == redo;
}

/// The edits that stand, and those that were taken back and can come again, each in order.
struct Stacks {
    std::vector<std::int64_t> standing;
    std::vector<std::int64_t> undone;
};

Stacks stacks_of(const std::vector<HistoryEntry>& history) {
    Stacks stacks;
    for (const HistoryEntry& entry : history) {
        if (entry.command == undo && !stacks.standing.empty()) {
            stacks.undone.push_back(stacks.standing.back());
            stacks.standing.pop_back();
        } else if (entry.command == redo && !stacks.undone.empty()) {
            stacks.standing.push_back(stacks.undone.back());
            stacks.undone.pop_back();
        } else if (entry.can_undo) {
            stacks.standing.push_back(entry.edit);
            stacks.undone.clear();
        }
    }
    return stacks;
}

/// Puts the rows of an edit as they were before it, or after it.
void put_rows(SqliteDatabase& database, std::int64_t edit, bool back) {
    SqliteStatement changes =
        database.prepare(std::string("SELECT \"table\", row_id, before, after FROM ") + schema::changes +
                         " WHERE edit = ? ORDER BY fid" + (back ? " DESC" : ""));
    changes.bind(1, edit);
    std::map<std::string, StoredTable> tables;
    const auto cells = [&](int column) -> JsonRow {
        return sqlite3_column_type(changes.get(), column) == SQLITE_NULL ? JsonRow(nullptr)
                                                                         : JsonRow::parse(changes.text(column));
    };
    while (database.step(changes)) {
        const std::string name = changes.text(0);
        const std::set<std::string> known{schema::boreholes, schema::samples, schema::surfaces, schema::vertices,
                                          schema::meta};
        if (!known.contains(name)) {
            throw InputError(database.file() + ": layer " + schema::changes + " names a table '" + name +
                             "' that no edit changes");
        }
        StoredTable& table = tables.try_emplace(name, database, name).first->second;
        const std::int64_t row = changes.integer(1);
        try {
            const JsonRow from = cells(back ? 3 : 2);
            const JsonRow to = cells(back ? 2 : 3);
            const JsonRow found = table.read(row);
            for (const auto& [column, value] : from.items()) {
                if (found.is_null() || found.value(column, JsonRow(nullptr)) != value) {
                    throw InputError(database.file() + ": layer " + name + ", row " + std::to_string(row) +
                                     " is not as edit " + std::to_string(edit) +
                                     " left it: another program has changed it");
                }
            }
            table.put(row, to);
        } catch (const nlohmann::json::exception& error) {
            throw InputError(database.file() + ": layer " + schema::changes + " is damaged: " + error.what());
        }
    }
}

std::vector<JournalEntry> step(const std::string& path, std::size_t count, bool back) {
    if (is_connection(path)) {
        throw UsageError(path + ": models in PostGIS cannot be edited yet; edit a GeoPackage");
    }
    const std::vector<HistoryEntry> history = load_history(path);  // looks the file over as well
    Stacks stacks = stacks_of(history);
    auto& stack = back ? stacks.standing : stacks.undone;
    if (stack.size() < count) {
        const std::string left = stack.empty() ? "nothing" : "only " + std::to_string(stack.size());
        throw UsageError(path + ": there is " + left + " to " + (back ? undo : redo));
    }
    SqliteDatabase database(path);
    SqliteTransaction transaction(database);
    const SqliteStatement last = database.prepare(std::string("SELECT max(edit) FROM ") + schema::journal);
    if (!database.step(last) || last.integer(0) != history.back().edit) {
        throw Error(path + ": somebody else has edited the model meanwhile; nothing was done, try again");
    }
    std::vector<JournalEntry> done;
    std::int64_t number = history.back().edit;
    for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t edit = stack.back();
        stack.pop_back();
        put_rows(database, edit, back);
        done.push_back(*std::ranges::find(history, edit, &HistoryEntry::edit));
        add_to_journal(database, {++number, "", back ? undo : redo, nlohmann::json{{"edit", edit}}.dump()});
    }
    transaction.commit();
    return done;
}

}  // namespace

std::vector<HistoryEntry> load_history(const std::string& path) {
    std::vector<HistoryEntry> history;
    for (JournalEntry& entry : load_journal(path)) {
        history.push_back({std::move(entry)});
    }
    std::map<std::int64_t, std::size_t> rows;
    {
        GdalScope scope(path);
        const Dataset dataset = open_model(path, scope);
        LayerReader layer(*dataset, scope, path, schema::changes);
        const schema::ChangeColumns columns(layer);
        while (layer.next()) {
            ++rows[layer.required_integer_at(columns.edit)];
        }
    }
    for (HistoryEntry& entry : history) {
        const auto found = rows.find(entry.edit);
        entry.rows = found == rows.end() ? 0 : found->second;
        entry.can_undo = entry.rows > 0 && !is_step(entry);
    }
    const Stacks stacks = stacks_of(history);
    for (HistoryEntry& entry : history) {
        const std::int64_t edit = is_step(entry) ? of_edit(entry) : entry.edit;
        entry.undone = !is_step(entry) && entry.can_undo && std::ranges::count(stacks.standing, edit) == 0;
    }
    return history;
}

std::vector<JournalEntry> undo_edits(const std::string& path, std::size_t count) {
    return step(path, count, true);
}

std::vector<JournalEntry> redo_edits(const std::string& path, std::size_t count) {
    return step(path, count, false);
}

}  // namespace terratet
