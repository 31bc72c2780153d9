// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A coordinate system in the words of the CF conventions 1.8, appendix F.

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace terratet {

using CfAttribute = std::pair<std::string, std::variant<double, std::vector<double>, std::string>>;

/// The attributes of a grid-mapping variable: name and parameters of the projections that the convention knows
/// (transverse Mercator, Lambert, Albers, azimuthal, stereographic, Mercator, longitude and latitude), the ellipsoid,
/// `crs_wkt` always, and `esri_pe_string`, which ArcGIS reads. Empty for an empty or local system.
std::vector<CfAttribute> cf_grid_mapping(const std::string& wkt);

}  // namespace terratet
