// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The order of a stored model's lists, once edits have numbered its rows otherwise, and the journal that tells of
/// them.

#include <string>

#include "io/model/sqlite_database.hpp"
#include "io/model_store.hpp"

namespace terratet {

/// Boreholes go by id, samples in canonical order; of surfaces and sheets the text names the rows.
std::string row_order_text(const RowNumbers& numbers);

/// Brings lists that were read by row into that order, with all that refers to them. Throws InputError for rows that
/// are not there, naming `file`.
void put_in_order(const std::string& row_order, Model& model, RowNumbers& numbers, const std::string& file);

/// What terratet_meta holds.
std::string stored_digest(SqliteDatabase& database);

/// Throws Error unless digest and journal are those of the state.
void require_state(SqliteDatabase& database, const StoredState& state);

/// With the present time where it has none.
void add_to_journal(SqliteDatabase& database, const JournalEntry& entry);

}  // namespace terratet
