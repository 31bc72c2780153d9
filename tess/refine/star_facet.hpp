// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The cell that an insertion would make over a facet of its conflict zone's boundary.

#include <algorithm>
#include <array>

#include "tess/mesh/delaunay.hpp"
#include "tess/mesh/quality.hpp"

namespace terratet {

using FacetCorners = std::array<Vec3, 3>;

inline FacetCorners facet_corners(const delaunay::Facet& facet) {
    FacetCorners corners;
    for (int k = 1; k < 4; ++k) {
        corners[static_cast<std::size_t>(k - 1)] =
            delaunay::from_cgal(facet.first->vertex((facet.second + k) & 3)->point());
    }
    return corners;
}

/// Is no corner nearer to the point?
inline bool clear_of(const FacetCorners& corners, const Vec3& point, double squared_limit) {
    return std::ranges::none_of(corners,
                                [&](const Vec3& corner) { return squared_distance(corner, point) < squared_limit; });
}

/// As cell_sharpness.
inline double star_sharpness(const FacetCorners& c, const Vec3& apex, double least, double enough) {
    return cell_sharpness({apex, c[0], c[1], c[2]}, least, enough);
}

}  // namespace terratet
