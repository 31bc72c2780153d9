// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Circumcentres with a bound on their error.

#include <array>

#include "tess/geometry.hpp"

namespace terratet {

struct CertifiedSphere {
    Vec3 center;
    double squared_radius;  ///< from the centre to the first point
    bool certified;         ///< the centre is within `relative_error` radii of the true one
};

/// The circumsphere of four points that span a volume, however little: in doubles where their error bound suffices,
/// then in long doubles, then in rational numbers. Only the rounding of the result to doubles can leave it uncertified
/// (sites a million radii from the origin).
CertifiedSphere certified_circumsphere(const std::array<Vec3, 4>& points, double relative_error);

}  // namespace terratet
