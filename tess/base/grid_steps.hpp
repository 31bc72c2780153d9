// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How fine the grid on the hull box' faces is.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tess/geometry.hpp"

namespace terratet {

/// Into how many equal steps each side is divided: of at most l_max/√2, a sixth of the diagonal and 1.5 times the
/// shortest side, and never finer than l_min. The latter two are what cells would ask for in the end, so that a larger
/// l_max does not make more of them. Whole numbers, but perhaps astronomical.
inline std::array<double, 3> grid_steps(const Box3& hull, double l_min, double l_max) {
    const Vec3 size = hull.size();
    const double spacing =
        std::min({l_max / std::numbers::sqrt2, hull.diagonal() / 6, 1.5 * std::min({size.x, size.y, size.z})});
    std::array<double, 3> steps{};
    for (int axis = 0; axis < 3; ++axis) {
        steps[static_cast<std::size_t>(axis)] =
            std::max(1.0, std::min(std::ceil(size[axis] / spacing), std::floor(size[axis] / l_min)));
    }
    return steps;
}

}  // namespace terratet
