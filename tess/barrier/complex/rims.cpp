// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/rims.hpp"

#include <algorithm>
#include <optional>

#include "tess/base/sight.hpp"

namespace terratet {
namespace {

constexpr std::uint32_t leaf_size = 8;

}  // namespace

FreeRims::FreeRims(const std::vector<EdgePlace>& rims, double spacing, const Vec3& normal) : spacing_(spacing) {
    if (rims.empty() || !(spacing > 0)) {
        return;
    }
    slab_ = Slab(rims.front()[0], normal);
    for (const EdgePlace& edge : rims) {
        for (const Vec3& end : edge) {
            slab_.extend(end);
        }
    }
    tree_ = BoxTree<EdgePlace>(
        rims, leaf_size,
        [&](auto& node, const EdgePlace& edge) {
            Box3 box;
            box.extend(edge[0]);
            box.extend(edge[1]);
            box = box.grown(spacing);
            node.box.extend(box.lo);
            node.box.extend(box.hi);
        },
        [](const EdgePlace& edge, int axis) { return edge[0][axis] + edge[1][axis]; });
}

double FreeRims::clearance(const Vec3& a, const Vec3& b, double least) const {
    // What is farther off their slab than the spacing is farther from the rims.
    const auto piece = tree_.items().empty() ? std::nullopt : slab_.piece(a, b, spacing_);
    if (!piece) {
        return least;
    }
    const Sight sight(piece->first, piece->second);
    static_cast<void>(tree_.any([&](const auto& node) { return !sight.misses(node.box); },
                                [&](const EdgePlace& edge) {
                                    least = std::min(least, segment_distance(a, b, edge[0], edge[1]) / spacing_);
                                    return false;
                                }));
    return least;
}

double segment_distance(const Vec3& p1, const Vec3& q1, const Vec3& p2, const Vec3& q2) {
    const Vec3 d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
    const double a = dot(d1, d1), e = dot(d2, d2), f = dot(d2, r);
    double s = 0, t = 0;
    if (a > 0 && e > 0) {
        const double b = dot(d1, d2), c = dot(d1, r);
        const double det = a * e - b * b;
        s = det > 0 ? std::clamp((b * f - c * e) / det, 0.0, 1.0) : 0;
        t = (b * s + f) / e;
        if (t < 0) {
            t = 0;
            s = std::clamp(-c / a, 0.0, 1.0);
        } else if (t > 1) {
            t = 1;
            s = std::clamp((b - c) / a, 0.0, 1.0);
        }
    } else if (a > 0) {
        s = std::clamp(-dot(d1, r) / a, 0.0, 1.0);
    } else if (e > 0) {
        t = std::clamp(f / e, 0.0, 1.0);
    }
    return distance(p1 + s * d1, p2 + t * d2);
}

}  // namespace terratet
