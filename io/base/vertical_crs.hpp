// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Whose heights a coordinate system means: globes want them above the ellipsoid.

#include <string>

#include "io/base/crs.hpp"

namespace terratet {

/// The system with heights of another. \param vertical  its EPSG code ("EPSG:5773" or "5773"); empty: as it is. A
/// system without a place on the globe stays as it is, too. Throws UsageError for one without an EPSG code, or when
/// PROJ does not know the other.
Crs with_vertical(const Crs& crs, const std::string& vertical);

/// What a user should know where a system says nothing of its heights, and nothing else does; else empty.
std::string heights_remark(const Crs& crs, const std::string& vertical);

}  // namespace terratet
