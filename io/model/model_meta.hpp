// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What of a model is no row of a layer, as the key/value pairs of terratet_meta.

#include <map>
#include <string>
#include <vector>

#include "tess/model.hpp"

namespace terratet {

using Meta = std::map<std::string, std::string>;

/// Number of rows a layer must have, since a lost row is otherwise no visible damage.
struct RowCounts {
    std::size_t samples = 0, boreholes = 0, surfaces = 0, vertices = 0;
    friend bool operator==(const RowCounts&, const RowCounts&) = default;
};

RowCounts row_counts(const Model& model);

/// Values are JSON but for plain words; doubles have all the digits they need.
/// \param censored_columns  schema::censored_columns
Meta to_meta(const Model& model, const std::vector<std::string>& property_columns,
             const std::vector<std::string>& censored_columns);

/// What the file says of itself, from meta alone; rows are still empty.
struct MetaContent {
    Model model;
    std::vector<std::string> property_columns;
    std::vector<std::string> censored_columns;  ///< empty texts for properties without
    RowCounts counts;
    std::string digest;  ///< empty when not stored
};

/// Throws InputError naming `file` and the key.
MetaContent from_meta(const Meta& meta, const std::string& file);

}  // namespace terratet
