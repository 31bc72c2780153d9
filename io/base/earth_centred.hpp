// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// From places on the globe to metres from its centre.

#include <cmath>
#include <numbers>

#include "tess/geometry.hpp"

namespace terratet {

inline constexpr double radian_per_degree = std::numbers::pi / 180;

/// Earth-centred coordinates of longitude and latitude in degrees and an ellipsoidal height, WGS 84.
inline Vec3 earth_centred(const Vec3& place) {
    constexpr double a = 6378137;
    constexpr double f = 1 / 298.257223563;
    constexpr double e2 = f * (2 - f);
    const double sin_lat = std::sin(place.y * radian_per_degree);
    const double cos_lat = std::cos(place.y * radian_per_degree);
    const double n = a / std::sqrt(1 - e2 * sin_lat * sin_lat);
    return {(n + place.z) * cos_lat * std::cos(place.x * radian_per_degree),
            (n + place.z) * cos_lat * std::sin(place.x * radian_per_degree), (n * (1 - e2) + place.z) * sin_lat};
}

}  // namespace terratet
