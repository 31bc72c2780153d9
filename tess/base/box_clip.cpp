// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/base/box_clip.hpp"

namespace terratet {
namespace {

/// The part on the inner side of one face.
std::vector<Vec3> clipped(const std::vector<Vec3>& polygon, int axis, double limit, bool upper) {
    std::vector<Vec3> result;
    const auto depth = [&](const Vec3& p) { return upper ? limit - p[axis] : p[axis] - limit; };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3& p = polygon[i];
        const Vec3& q = polygon[(i + 1) % polygon.size()];
        if (depth(p) >= 0) {
            result.push_back(p);
        }
        if ((depth(p) > 0 && depth(q) < 0) || (depth(p) < 0 && depth(q) > 0)) {
            result.push_back(p + (depth(p) / (depth(p) - depth(q))) * (q - p));
        }
    }
    return result;
}

}  // namespace

std::vector<Vec3> clipped(std::vector<Vec3> polygon, const Box3& box) {
    for (int axis = 0; axis < 3; ++axis) {
        polygon = clipped(polygon, axis, box.lo[axis], false);
        polygon = clipped(polygon, axis, box.hi[axis], true);
    }
    return polygon;
}

}  // namespace terratet
