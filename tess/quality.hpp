// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Shape and size of a tetrahedron.

#include <array>

#include "tess/geometry.hpp"

namespace terratet {

struct CellQuality {
    double shortest_edge = 0;
    double longest_edge = 0;
    double volume = 0;        ///< unsigned
    double circumradius = 0;  ///< infinity for a cell without volume
    double inradius = 0;
    double radius_edge = 0;       ///< R/ℓ; regular 0.612
    double aspect = 0;            ///< β = R/r; regular 3; infinity without volume
    double dihedral_min_deg = 0;  ///< regular 70.53
    double dihedral_max_deg = 0;
};

using CellPoints = std::array<Vec3, 4>;

/// All measures; independent of the orientation, though its last bits depend on the order of the points.
CellQuality cell_quality(const CellPoints& points);

/// Cosine of the smallest dihedral angle alone: no arc cosine, for comparisons in inner loops. 1 without volume.
double sharpest_dihedral_cosine(const CellPoints& points);

struct Circumsphere {
    Vec3 center;  ///< not finite for a cell without volume
    double squared_radius = 0;
};

/// Computed relative to the first point. Bit-identical only for the same order of points: callers that promise
/// determinism order them by vertex id.
Circumsphere circumsphere(const CellPoints& points);

}  // namespace terratet
