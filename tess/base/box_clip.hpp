// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What of a polygon lies in a box.

#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// Corners of the part of a convex polygon within the box (Sutherland and Hodgman); empty when they do not meet.
std::vector<Vec3> clipped(std::vector<Vec3> polygon, const Box3& box);

}  // namespace terratet
