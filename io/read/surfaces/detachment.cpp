// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/read/surfaces/detachment.hpp"

#include <algorithm>
#include <cmath>

#include "tess/samples.hpp"

namespace terratet {
namespace {

constexpr double rim = 1e-9;  ///< a way that touches a triangle's edge meets it, lest it slip between two

/// How far along the way it meets the triangle, in lengths of `direction`; NaN: it does not.
double met(const Vec3& place, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 along = b - a;
    const Vec3 beside = c - a;
    const Vec3 p = cross(direction, beside);
    const double volume = dot(along, p);
    const Vec3 from = place - a;
    const double u = dot(from, p) / volume;
    const Vec3 q = cross(from, along);
    const double v = dot(direction, q) / volume;
    const double t = dot(beside, q) / volume;
    return u >= -rim && v >= -rim && u + v <= 1 + rim && t > 0 ? t : missing;
}

/// Does the way pass the box, no farther than `most`?
bool passes(const Vec3& place, const Vec3& direction, const Box3& box, double most) {
    double first = 0;
    double last = most;
    for (int axis = 0; axis < 3; ++axis) {
        const double slack = rim * (std::abs(box.lo[axis]) + std::abs(box.hi[axis]));
        const double lo = box.lo[axis] - slack - place[axis];
        const double hi = box.hi[axis] + slack - place[axis];
        if (direction[axis] == 0) {
            if (lo > 0 || hi < 0) {
                return false;
            }
            continue;
        }
        const auto [in, out] = std::minmax({lo / direction[axis], hi / direction[axis]});
        first = std::max(first, in);
        last = std::min(last, out);
    }
    return first <= last;
}

}  // namespace

Detachment::Detachment(const std::vector<Surface>& surfaces) {
    std::vector<Triangle> triangles;
    for (const Surface& surface : surfaces) {
        for (const auto& triangle : surface.triangles) {
            triangles.push_back(
                {surface.vertices[triangle[0]], surface.vertices[triangle[1]], surface.vertices[triangle[2]]});
        }
    }
    tree_ = BoxTree<Triangle>(
        std::move(triangles), 8,
        [](auto& node, const Triangle& triangle) {
            node.box.extend(triangle.a);
            node.box.extend(triangle.b);
            node.box.extend(triangle.c);
        },
        [](const Triangle& triangle, int axis) { return triangle.a[axis] + triangle.b[axis] + triangle.c[axis]; });
}

double Detachment::met_from(const Vec3& place, const Vec3& direction) const {
    double best = HUGE_VAL;
    const bool all_seen = !tree_.any([&](const auto& node) { return passes(place, direction, node.box, best); },
                                     [&](const Triangle& triangle) {
                                         const double t = met(place, direction, triangle.a, triangle.b, triangle.c);
                                         best = std::isnan(t) ? best : std::min(best, t);
                                         return false;
                                     });
    return all_seen && std::isfinite(best) ? place.z + best * direction.z : missing;
}

}  // namespace terratet
