// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What page and picture say in words.

#include <string>

#include "io/write/scene/scene.hpp"

namespace terratet {

/// "EPSG:3067 ETRS89 / TM35FIN(E,N)", or that there is none.
std::string crs_title(const Frame& frame);

/// "m", "ft", or the unit as it is called.
std::string short_unit(const Frame& frame);

/// How many samples, how well they are met, how much lies beyond their reach.
std::string honesty(const Scene& scene, const ModelView& view);

/// How much to stretch heights for a flat model to be seen: 1, 2, 5, 10 …
double height_stretch(const Model& model);

/// Of the title, else of the file's name.
std::string scene_title(const ExportOptions& options, const std::string& path);

/// A property's quartiles among the samples, measured; those at either end of its values are left out.
std::vector<double> sample_quartiles(const Model& model, std::size_t property);

}  // namespace terratet
