// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Grids to grids: what there is already into other formats, and a model's values onto it.

#include <string>
#include <vector>

#include "interp/model_snapshot.hpp"
#include "tools/options/export_options.hpp"
#include "tools/options/run_options.hpp"

namespace terratet::tools {

/// Writes a grid in other formats of voxels. Throws UsageError for outputs that a grid cannot be.
void export_grid(const std::string& input, const std::vector<std::string>& outputs, const ExportArguments& arguments,
                 const RunArguments& run);

/// Writes what `query value` says at the grid's places; of a mesh (io/onto/place_mesh.hpp), at its nodes and at its
/// cells' centres, to .vtu and .csv.
void resample_onto(const ModelSnapshot& model, const std::string& onto, const std::vector<std::string>& outputs,
                   const ExportArguments& arguments, const RunArguments& run);

}  // namespace terratet::tools
