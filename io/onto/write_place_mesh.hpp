// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Somebody else's mesh with a model's values.

#include <string>

#include "io/export_options.hpp"
#include "io/onto/place_mesh.hpp"
#include "tess/model.hpp"
#include "tess/value_source.hpp"

namespace terratet {

/// Of a model's properties, at a mesh's nodes and at its cells' centres.
struct MeshValues {
    ValueBatch nodes;
    ValueBatch cells;
};

/// To .vtu: the mesh as it was read, with an array a property, and the extrapolation, at points and at cells; names,
/// units and classes as field data, as in the model's own. To .csv: a row a node and a row a cell: of (node, cell),
/// number from 0, x, y, z, the properties, extrapolation; nothing where there is no value. Throws UsageError for
/// another extension, Error as OutputFile does.
OutputRecord write_place_mesh(const PlaceMesh& mesh, const MeshValues& values, const Model& model,
                              const std::string& path, const ExportOptions& options);

}  // namespace terratet
