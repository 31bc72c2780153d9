// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What to write: the options behind io/export.hpp.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/export.hpp"
#include "io/source.hpp"
#include "tools/options/option.hpp"

namespace terratet::tools {

using VoxelSize = std::array<Length, 3>;

struct ExportArguments {
    ExportOptions writers;  ///< what needs neither a unit nor a model; its defaults are those of the options
    std::optional<VoxelSize> voxel_size;
    bool clip = false;
    bool compress = false;
    bool uncompressed = false;   ///< -co COMPRESS=NO
    bool spatial_index = false;  ///< -co SPATIAL_INDEX=YES
    bool dry_run = false;
    bool uncertainty = false;
    bool voxels = false;
};

std::vector<OptionGroup> export_options(ExportArguments& arguments);

/// Creation options (-co COMPRESS=YES), each as its named twin (--compress).
Parsed creation_options(ExportArguments& arguments);

/// `FILE[,of=FORMAT]`. Throws UsageError when nothing is left of the file's name.
OutputRequest parse_output(const std::string& text);

/// The same, with the format that --voxels makes of a tileset.
OutputRequest parse_output(const std::string& text, const ExportArguments& arguments);

/// Lengths in the unit of the model. Throws UsageError: also for a property to colour by that there is none of.
ExportOptions writer_options(const ExportArguments& arguments, const Model& model);

}  // namespace terratet::tools
