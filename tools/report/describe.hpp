// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What is in a model, a table or a file of surfaces: for `terratet info`.

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "io/model_store.hpp"
#include "io/read/site/hole_quality.hpp"
#include "io/read/surfaces/read_surfaces.hpp"
#include "io/read/tables/read_table.hpp"

namespace terratet::tools {

nlohmann::ordered_json describe_model(const Model& model, const std::vector<JournalEntry>& journal);
nlohmann::ordered_json describe_surfaces(const RawSurfaces& surfaces, const Diagnostics& diagnostics);

/// An input or an output of any kind: a well file, an output (io/write/seen_output.hpp), surfaces, layers, a table.
nlohmann::ordered_json describe_file(const Source& source, const ColumnNames& columns);

/// For `terratet info --holes`.
nlohmann::ordered_json describe_holes(const HoleQuality& quality, const Diagnostics& diagnostics);

/// The same for people: one line a key, lists indented below theirs.
std::string as_text(const nlohmann::ordered_json& description);

}  // namespace terratet::tools
