// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Workbooks, databases and GeoPackages that hold collars, surveys and logs as layers: found by what their columns are,
/// whatever the layers are called.

#include <string>
#include <vector>

#include "io/read/tables/read_table.hpp"
#include "io/source.hpp"

namespace terratet {

/// What a layer of a file can be for boreholes.
enum class LayerUse { collar, survey, log, other };

struct HoleLayer {
    std::string name;
    LayerUse use = LayerUse::other;
    std::vector<std::string> columns;
};

/// By columns: a hole's id with a place is a collar; with azimuth, dip and depth a survey; with from and to, or a
/// depth, a log. `points`: the layer has point geometry.
LayerUse use_of(const Table& titles, bool points, const ColumnNames& names);

/// The layers of a file that GDAL opens; one or none for what is no container. Streams are not looked at.
std::vector<HoleLayer> hole_layers(const Source& source, const ColumnNames& names);

/// "collar", "survey", "log", "other".
const char* to_string(LayerUse use);

}  // namespace terratet
