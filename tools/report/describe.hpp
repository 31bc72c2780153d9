// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What is in a model, a table or a file of surfaces: for `terratet info`.

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "io/model_store.hpp"
#include "io/read/surfaces/read_surfaces.hpp"
#include "io/read/tables/read_table.hpp"

namespace terratet::tools {

nlohmann::ordered_json describe_model(const Model& model, const std::vector<JournalEntry>& journal);
nlohmann::ordered_json describe_table(const Table& table);
nlohmann::ordered_json describe_surfaces(const RawSurfaces& surfaces, const Diagnostics& diagnostics);

/// The same for people: one line a key, lists indented below theirs.
std::string as_text(const nlohmann::ordered_json& description);

}  // namespace terratet::tools
