// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Circumcentres with a bound on their error.

#include <array>
#include <cstddef>

#include "tess/geometry.hpp"

namespace terratet {

struct CertifiedSphere {
    Vec3 center;
    double squared_radius;  ///< from the centre to one of the points
    bool certified;         ///< the centre is within `relative_error` radii of the true one
};

/// Which of the four has the shortest edges: seen from there the centre's error is least, by the ratio of edges where
/// one point lies far away.
std::size_t nearest_to_others(const std::array<Vec3, 4>& points);

/// The circumsphere of four points that span a volume, however little: in doubles where their error bound suffices,
/// then in long doubles, floats of 113 bits, rational numbers. Only the rounding of the result to doubles can leave it
/// uncertified (sites a million radii from the origin).
CertifiedSphere certified_circumsphere(const std::array<Vec3, 4>& points, double relative_error);

}  // namespace terratet
