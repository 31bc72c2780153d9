// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Shape and size of a tetrahedron.

#include <array>
#include <cmath>

#include "tess/tet_mesh.hpp"

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

inline CellPoints cell_points(const TetMesh& mesh, const std::array<std::uint32_t, 4>& cell) {
    return {mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]], mesh.points[cell[3]]};
}

/// All measures; independent of the orientation, though its last bits depend on the order of the points.
CellQuality cell_quality(const CellPoints& points);

/// Sharpness of a dihedral angle: the square of its cosine with the cosine's sign, which orders as the cosine does and
/// costs neither root nor arc. From −1 to 1, larger for a smaller angle.
inline double sharpness(double cosine) {
    return cosine * std::abs(cosine);
}
inline double cosine_of(double sharpness) {
    return sharpness <= 1 ? std::copysign(std::sqrt(std::abs(sharpness)), sharpness) : 1;
}

/// The larger of `least` and the sharpness of the cell's smallest dihedral angle; infinity without volume. Ends early
/// once above `enough`.
double cell_sharpness(const CellPoints& points, double least = -1, double enough = 1);

struct Circumsphere {
    Vec3 center;  ///< not finite for a cell without volume
    double squared_radius = 0;
    double six_volumes = 0;  ///< a by-product: six times the cell's volume, positive for an outward-ordered cell
};

/// Computed relative to the first point. Bit-identical only for the same order of points: callers that promise
/// determinism order them by vertex id.
Circumsphere circumsphere(const CellPoints& points);

}  // namespace terratet
