// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/touched_complex.hpp"

#include <algorithm>
#include <array>

#include "tess/geometry.hpp"

namespace terratet {
namespace {

bool touch(const Box3& a, const Box3& b) {
    return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
           b.lo.z <= a.hi.z;
}

std::vector<Box3> boxes_of(const Surface& surface, double margin) {
    std::vector<Box3> boxes;
    for (const Triangle& t : surface.triangles) {
        const std::array<Vec3, 3> corners{surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]};
        boxes.push_back(bounding_box(corners).grown(margin));
    }
    return boxes;
}

bool near(const Surface& a, const Surface& b, double reach) {
    const Box3 around = bounding_box(b.vertices).grown(reach);
    std::vector<Box3> first = boxes_of(a, reach);
    std::erase_if(first, [&](const Box3& box) { return !touch(box, around); });
    if (first.empty()) {
        return false;
    }
    const std::vector<Box3> second = boxes_of(b, 0);
    return std::ranges::any_of(first, [&](const Box3& box) {
        return std::ranges::any_of(second, [&](const Box3& other) { return touch(box, other); });
    });
}

}  // namespace

std::vector<std::size_t> touched_complex(std::span<const Surface> before, std::span<const Surface> after,
                                         double reach) {
    std::vector<const Surface*> waiting;
    std::vector<bool> touched(after.size());
    for (const Surface& surface : before) {
        if (std::ranges::find(after, surface) == after.end()) {
            waiting.push_back(&surface);
        }
    }
    const auto take = [&](std::size_t i) {
        touched[i] = true;
        waiting.push_back(&after[i]);
    };
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (std::ranges::find(before, after[i]) == before.end()) {
            take(i);
        }
    }
    while (!waiting.empty()) {
        const Surface& from = *waiting.back();
        waiting.pop_back();
        for (std::size_t i = 0; i < after.size(); ++i) {
            if (!touched[i] && near(from, after[i], reach)) {
                take(i);
            }
        }
    }
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (touched[i]) {
            result.push_back(i);
        }
    }
    return result;
}

}  // namespace terratet
