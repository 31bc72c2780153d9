// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What to write: the options behind io/export.hpp.

#include <string>
#include <vector>

#include "io/export.hpp"
#include "tools/options/option.hpp"

namespace terratet::tools {

struct ExportArguments {
    std::string format;
    std::string voxel_size;
    std::string values = "linear";
    bool margin = false;
    bool voronoi = false;
    bool clip = false;
    bool compress = false;
    bool uncompressed = false;   ///< -co COMPRESS=NO
    bool spatial_index = false;  ///< -co SPATIAL_INDEX=YES
    bool allow_large = false;
    bool dry_run = false;
    bool half = false;
    bool msh_version_2 = false;  ///< -co VERSION=2.2
    bool centred = false;        ///< -co ALIGN=NO
    bool all_fields = false;     ///< -co FIELDS=ALL
    bool local_origin = false;
    bool uncertainty = false;
    bool voxels = false;
    std::string vertical_srs;  ///< -co VERTICAL_SRS=EPSG:…
    std::string fault_gap = "keep";
    std::string color;
    std::string color_map = ExportOptions{}.color_map;
    std::vector<std::string> sections;
    std::vector<std::string> iso;
    std::string max_extrapolation;
    std::string size;
    std::string frame;
    std::vector<std::string> creation_options;
};

std::vector<OptionGroup> export_options(ExportArguments& arguments);

/// Creation options (-co COMPRESS=YES) put into their named twins (--compress). Throws UsageError for an unknown one.
ExportArguments with_creation_options(ExportArguments arguments);

/// `FILE[,of=FORMAT]`. Throws UsageError when nothing is left of the file's name.
OutputRequest parse_output(const std::string& text);

/// The same, with the format that --voxels makes of a tileset.
OutputRequest parse_output(const std::string& text, const ExportArguments& arguments);

/// Throws UsageError for what can be refused before there is a model.
void check_export_arguments(const ExportArguments& arguments);

/// Lengths in the unit of the model. Throws UsageError: also for a property to colour by that there is none of.
ExportOptions writer_options(const ExportArguments& arguments, const Model& model);

}  // namespace terratet::tools
