// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Are places where their coordinate system is for?

#include <string>
#include <vector>

#include "io/base/crs.hpp"

namespace terratet {

/// What to say of places of which some lie outside the area of use of their system, by more than a tenth of its size or
/// a degree: how many, where the area is, and whether they would lie within with x and y exchanged. Empty when all lie
/// within, and for systems without such an area. NaN: no place. At most ten thousand are looked at.
std::string outside_area_of_use(const std::vector<Vec3>& points, const Crs& crs);

}  // namespace terratet
