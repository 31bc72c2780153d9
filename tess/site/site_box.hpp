// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where a site's data lie: the box that defaults follow from, and what lies too far off to count.

#include <string>
#include <vector>

#include "tess/site.hpp"

namespace terratet {

/// A hole or a loose sample far from all others: a slip of the pen, or a collar without coordinates.
struct FarOff {
    std::string name;  ///< "hole 'D1'", "a sample"
    Vec3 place;        ///< in the site's coordinates
    double distance = 0;
};

struct SiteBox {
    Box3 box;  ///< of samples and boreholes but those far off; empty without any
    std::vector<FarOff> far_off;
};

/// Far off is, of three or more holes and loose samples, at most a quarter of them that lie more than 100 km from the
/// middle of all (the median of each coordinate) and a hundred times as far as the others do; ten times for a collar at
/// 0, 0. Works in any coordinates, frame-local or true. O(n log n).
SiteBox site_box(const Site& site, double metres_per_unit);

/// How many times as wide as high a box is; its width is that of a square with the same diagonal in plan. 0 for points
/// on a level plane or a plumb line, which have no shape to keep.
double flatness(const Box3& box);

/// The frame's z_scale that suits data in that box (unscaled): 1 up to a flatness of 10, then what makes them five
/// times as wide as high, to two digits.
double suitable_z_scale(const Box3& box);

}  // namespace terratet
