// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model file may come from anybody, and SQLite runs what a schema holds: views, triggers, generated columns. Before
/// GDAL opens it, this looks it over with SQLite itself, which runs none of it.

#include <string>

namespace terratet {

/// Does the file's schema name a layer terratet_meta, whatever it may be? False for what is no SQLite database.
/// Reads the schema only. Not for PG: connection strings.
bool holds_model(const std::string& path);

/// Throws InputError, naming the file and the layer, unless the model's layers and GeoPackage's own tables are plain
/// tables: no view or virtual table in their place, no trigger but GeoPackage's own (counts of rows, R-trees), no
/// generated column, no index over an expression or a part of the rows; and unless every cell of the model's layers
/// holds what its column is for (SQLite lets any cell hold anything), rows ascending. What others have added beside
/// these is not looked at. About 1 µs a row. \pre holds_model
void require_plain_model(const std::string& path);

}  // namespace terratet
