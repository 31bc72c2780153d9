// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/anisotropy.hpp"

#include <cmath>
#include <numbers>

namespace terratet {

Metric::Metric(const Anisotropy& anisotropy) : identity_(anisotropy.isotropic()) {
    constexpr double degree = std::numbers::pi / 180;
    // GSLIB's setrot: the first angle from east, anticlockwise.
    const double alpha = (90 - anisotropy.azimuth_deg) * degree;
    const double beta = anisotropy.dip_deg * degree;
    const double theta = anisotropy.roll_deg * degree;
    const double sin_a = std::sin(alpha);
    const double cos_a = std::cos(alpha);
    const double sin_b = std::sin(beta);
    const double cos_b = std::cos(beta);
    const double sin_t = std::sin(theta);
    const double cos_t = std::cos(theta);
    rows_[0] = {cos_b * cos_a, cos_b * sin_a, -sin_b};
    rows_[1] = Vec3{-cos_t * sin_a + sin_t * sin_b * cos_a, cos_t * cos_a + sin_t * sin_b * sin_a, sin_t * cos_b} /
               anisotropy.ratio2;
    rows_[2] = Vec3{sin_t * sin_a + cos_t * sin_b * cos_a, -sin_t * cos_a + cos_t * sin_b * sin_a, cos_t * cos_b} /
               anisotropy.ratio3;
}

}  // namespace terratet
