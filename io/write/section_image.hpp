// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A section as an image: GeoTIFF to measure in, SVG to look at.

#include <memory>
#include <string>
#include <vector>

#include "io/write/write_rows.hpp"
#include "tess/property.hpp"

namespace terratet {

/// By extension: .tif, .tiff or .svg?
bool is_section_image(const std::string& path);

/// Takes a section's polygons (Row::flat) and writes them at the end, whole or not at all.
///
/// GeoTIFF: a band a property (Float64, NaN: nothing there), 2000 pixels along the longer side, each the value that the
/// cell has at the pixel's middle, of a category the index of the class there is most of (band metadata CLASS_0, …).
/// Its axes are the distance along the section and the height; of a horizontal plane x and y, in the frame's CRS.
/// SVG: a panel a property, polygons coloured by their mean, with axes and a legend.
///
/// Throws Error when the file exists and `overwrite` is false, when there is no polygon, or when writing fails.
std::unique_ptr<RowSink> section_to_image(const std::string& path, const std::vector<Property>& properties,
                                          const Frame& frame, bool overwrite);

}  // namespace terratet
