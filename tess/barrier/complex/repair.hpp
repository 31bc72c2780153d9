// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// From a surface as read, a soup of triangles with any defect, to clean oriented sheets.

#include <cstddef>
#include <vector>

#include "tess/base/tri_mesh.hpp"
#include "tess/surface.hpp"

namespace terratet {

struct RepairedSheet {
    std::vector<TriMesh> parts;  ///< connected, edge- and vertex-manifold, facing the same way; larger area first
    std::size_t dropped = 0;     ///< triangles without a usable corner or an area, or doubled
    double area = 0;             ///< of the parts
};

/// Merges points nearer than `tolerance`, drops degenerate and doubled triangles, orients, cuts apart where more than
/// two triangles meet in an edge or two fans in a point, splits by connection. Independent of the order of vertices and
/// triangles. O(n log n).
RepairedSheet repair_sheet(const Surface& surface, double tolerance);

/// Takes out triangles, the worst first, until none cross in a part, and splits by connection again. Returns the area
/// taken out.
double drop_self_crossings(RepairedSheet& repaired);

}  // namespace terratet
