// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The model file: one GeoPackage (or PostGIS schema) with the layers of docs/model-file.md. Coordinates in it are true
/// ones. Guarantee X3: a stored model reloads to the same model, vertex for vertex and bit for bit, and so to the same
/// tessellation.
///
/// Writing is one transaction, journal_mode=DELETE and synchronous=FULL set explicitly; a new file is written beside its
/// place and renamed, so that it appears whole or not at all.

#include <string>
#include <vector>

#include "tess/model.hpp"

namespace terratet {

struct JournalEntry {
    std::int64_t edit = 0;
    std::string time;       ///< ISO 8601, UTC; SOURCE_DATE_EPOCH when set
    std::string command;
    std::string arguments;  ///< JSON
};

/// Writes a new model. Throws Error when the file exists and `overwrite` is false, or when writing fails (nothing is left).
void save_model(const std::string& path, const Model& model, const JournalEntry& entry, bool overwrite = false);

/// Throws InputError: not found, not a Terratet model, a newer format version, a layer missing or damaged (named).
Model load_model(const std::string& path);

std::vector<JournalEntry> load_journal(const std::string& path);

/// Is this file a Terratet model? False for anything else, also for what does not exist.
bool is_model(const std::string& path);

/// SHA-256 over the model's canonical content (vertices, values, criteria, frame; no times): equal digests mean equal
/// exports. Hex.
std::string model_digest(const Model& model);

}  // namespace terratet
