// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What makes a model file pleasant in a GIS, and is no part of the model: titles and descriptions of layers and
/// columns (gpkg_contents, gpkg_data_columns), styles (layer_styles, as QGIS looks for them), spatial indices. Neither
/// the digest nor reading knows of them; edits leave them as they are.

#include <string>

#include "io/model/sqlite_database.hpp"
#include "tess/model.hpp"

namespace terratet {

/// Into a new model's file, within the caller's transaction. A style a property for samples and vertices, the first
/// property's as the default; all of a model's properties in the colours and range of its scene.
/// \param time  as ISO 8601 has it
void write_styles(SqliteDatabase& database, const Model& model, const std::string& time);

/// R-trees on the layers, by GDAL. Takes four times as long as writing the rows. Throws Error naming `shown`.
void write_spatial_indices(const std::string& file, const std::string& shown);

}  // namespace terratet
