// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogr_geometry.h>

#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// Does the geometry show the triangles of the arrays? Else another program has edited it, in vain.
bool shows(const OGRGeometry* geometry, const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles);

}  // namespace terratet
