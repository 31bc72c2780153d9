// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Everything about boreholes that the inputs name, as tables: from tables, from the layers of workbooks and databases,
/// from well files (io/read/logs/well_file.hpp), from folders and patterns of files.

#include <vector>

#include "io/read/logs/well_file.hpp"
#include "io/read/read_positions.hpp"
#include "io/site_inputs.hpp"
#include "tess/diagnostics.hpp"

namespace terratet {

struct HoleInputs {
    std::vector<PlacedTable> collars;
    std::vector<Table> surveys;
    std::vector<Table> logs;
    std::vector<HolePath> paths;  ///< in `path_crs`
    std::vector<Crs> path_crs;    ///< of each path
};

/// How the inputs want places read.
PlaceOptions place_options(const SiteInputs& inputs);

/// Reads what `boreholes`, `surveys` and `logs` name.
///
/// A well file brings its own holes, logs and surveys; its log goes to the hole that a collar table knows by its UWI,
/// its API number, its name or the file's name, and only else to the place in its own header. A container (workbook,
/// database) given for boreholes brings the layers that are collars, surveys and logs; its logs are used unless a log
/// names the same file. Whatever was chosen is noted. Throws InputError: two layers could be the collars, no layer is
/// one, a well file without a place whose hole no table knows.
HoleInputs read_hole_inputs(const SiteInputs& inputs, Diagnostics& diagnostics);

}  // namespace terratet
