// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/frame.hpp"

#include <cmath>

namespace terratet {

namespace {

/// 0 unless the origin lies so well within the values' magnitude that X − O is exact: Sterbenz' lemma asks for
/// X/2 ≤ O ≤ 2X, which |X − O| ≤ |X|/2 implies; beyond that, O's coarse lattice makes the difference exact as long as
/// |X − O| ≤ |X|, for X − O is then a multiple of X's last place that is no larger than X.
double choose_axis_origin(double lo, double hi) {
    constexpr double step = 1024;
    const double origin = step * std::round((lo + hi) / 2 / step);
    const bool exact = std::abs(lo - origin) <= std::abs(lo) && std::abs(hi - origin) <= std::abs(hi);
    const bool crosses_zero = lo <= 0 && hi >= 0;
    return exact && !crosses_zero ? origin : 0;
}

}  // namespace

/// Dividing a product need not give back the factor, but the factor is one of the quotient's neighbours; likewise
/// behind the addition of the origin.
double Frame::world_z(double local) const {
    const double quotient = local / z_scale;
    for (const double offset : {quotient, std::nextafter(quotient, -HUGE_VAL), std::nextafter(quotient, HUGE_VAL)}) {
        const double world = origin.z + offset;
        if (z_scale * (world - origin.z) == local) {
            return world;
        }
    }
    return origin.z + quotient;
}

Vec3 choose_origin(const Box3& world_extent) {
    Vec3 origin;
    if (world_extent.empty()) {
        return origin;
    }
    for (int axis = 0; axis < 3; ++axis) {
        origin[axis] = choose_axis_origin(world_extent.lo[axis], world_extent.hi[axis]);
    }
    return origin;
}

}  // namespace terratet
