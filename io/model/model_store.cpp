// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/model_store.hpp"

#include "io/model/model_guard.hpp"
#include "io/model/model_schema.hpp"
#include "io/model/opened_model.hpp"
#include "io/model/sqlite_database.hpp"
#include "io/source.hpp"
#include "tess/error.hpp"

namespace terratet {

std::vector<JournalEntry> load_journal(const std::string& path) {
    GdalScope scope(path);
    const Dataset dataset = open_model(path, scope);
    LayerReader layer(*dataset, scope, path, schema::journal);
    const schema::JournalColumns columns(layer);
    std::vector<JournalEntry> entries;
    while (layer.next()) {
        entries.push_back({layer.required_integer_at(columns.edit), layer.required_text_at(columns.time),
                           layer.required_text_at(columns.command), layer.required_text_at(columns.arguments)});
    }
    return entries;
}

bool is_model(const std::string& path) {
    GdalScope scope(path);
    if (!is_connection(path)) {
        roll_back_interrupted(path);
        return holds_model(path);
    }
    try {
        return open_model(path, scope) != nullptr;
    } catch (const InputError&) {
        return false;
    }
}

}  // namespace terratet
