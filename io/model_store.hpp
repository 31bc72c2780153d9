// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The model file: one GeoPackage (or PostGIS schema) with the layers of docs/model-file.md. Coordinates in it are true
/// ones. Guarantee X3: a stored model reloads to the same model, vertex for vertex and bit for bit, and so to the same
/// tessellation.
///
/// Writing is one transaction, journal_mode=DELETE and synchronous=FULL set explicitly; a new file is written beside
/// its place and renamed, so that it appears whole or not at all.

#include <string>
#include <vector>

#include "tess/model.hpp"

namespace terratet {

struct JournalEntry {
    std::int64_t edit = 0;
    std::string time;  ///< ISO 8601, UTC; SOURCE_DATE_EPOCH when set
    std::string command;
    std::string arguments;  ///< JSON
};

struct SaveOptions {
    bool overwrite = false;
    bool spatial_index = false;  ///< R-trees on the layers, for other programs: four times the writing
};

/// Writes a new model. `path` may be a PG: connection string; the layers then go to its active schema. Throws Error
/// when the model exists and is not to be replaced, when a text is not UTF-8, or when writing fails (nothing is left;
/// what was there before stays). About 10 µs a vertex. \pre Every position is snapped (Frame::snapped); classes are
/// distinct; indices are in range; a barrier's sheet
///      and margin are of one kind; vertices of role domain and inserted have owner −1.
void save_model(const std::string& path, const Model& model, const JournalEntry& entry,
                const SaveOptions& options = {});
inline void save_model(const std::string& path, const Model& model, const JournalEntry& entry, bool overwrite) {
    save_model(path, model, entry, SaveOptions{.overwrite = overwrite});
}

/// Numbers of rows in the file, in step with the model's lists. Those of a new model count up from 1; sheets follow the
/// surfaces, each with its margin behind it.
struct RowNumbers {
    std::vector<std::int64_t> boreholes;
    std::vector<std::int64_t> samples;
    std::vector<std::int64_t> surfaces;
    std::vector<std::int64_t> sheets;  ///< of barriers; the margin is the next row
    std::vector<std::int64_t> vertices;
};

/// What a file says of the state it is in: what an edit of it starts from.
struct StoredState {
    RowNumbers numbers;
    std::string digest;
    std::int64_t last_edit = 0;  ///< the largest number in the journal
};

struct LoadOptions {
    /// The digest of what was stored is not asked for: the caller verifies what the model promises (tess/verify.hpp).
    bool accept_edited = false;
};

/// Throws InputError: not found, not a Terratet model, another format version, a layer or row missing or damaged
/// (named), a number that no model can hold (layer, row, column and what was found), or rows changed by another program
/// (the stored digest differs, or is missing). The file may come from anybody: nothing that its schema holds is run
/// (model_guard.hpp).
Model load_model(const std::string& path, const LoadOptions& options = {}, StoredState* state = nullptr);

/// Brings the file from one state to the next in one transaction, which writes the rows that differ and notes them in
/// terratet_changes: all or nothing, whatever happens. `before` and `state` are what load_model gave, or the last
/// store_edit; entry.edit is set to the next number. Returns the state it is in then. Throws Error when writing fails,
/// also when the file is in another state meanwhile (somebody else has edited it), and UsageError for PG: connection
/// strings.
StoredState store_edit(const std::string& path, const Model& before, const StoredState& state, const Model& after,
                       JournalEntry entry);

/// One line of the journal and what became of it.
struct HistoryEntry : JournalEntry {
    bool undone = false;
    bool can_undo = false;  ///< it changed rows: neither the build nor an undo itself
    std::size_t rows = 0;   ///< that it changed
};

/// In order. Throws InputError as load_model does.
std::vector<HistoryEntry> load_history(const std::string& path);

/// Takes back the last edits that stand, or brings back the last taken back (until another edit is made), in one
/// transaction: the rows become those that were there, bit for bit (X2). No source file is needed. Returns their
/// entries. Throws UsageError when there are not so many, InputError when a row is not as the edit left it, Error as
/// store_edit.
std::vector<JournalEntry> undo_edits(const std::string& path, std::size_t count = 1);
std::vector<JournalEntry> redo_edits(const std::string& path, std::size_t count = 1);

/// Throws InputError as load_model does.
std::vector<JournalEntry> load_journal(const std::string& path);

/// Is this a Terratet model, sound or not? False for anything else, also for what does not exist. Throws InputError for
/// a database that is damaged.
bool is_model(const std::string& path);

/// SHA-256 over the model's content (all of tess/model.hpp but the paths of input files; no times): equal digests mean
/// equal exports. Hex. The sign of zeros and the payload of NaNs do not count. About 1 s for ten million vertices.
std::string model_digest(const Model& model);

}  // namespace terratet
