// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/complex/rims.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "tess/base/sight.hpp"

namespace terratet {
namespace {

constexpr std::uint32_t leaf_size = 8;

}  // namespace

void FreeRims::add(const std::vector<EdgePlace>& rims, double spacing) {
    for (const auto& [from, to] : rims) {
        if (spacing > 0) {
            edges_.push_back({from, to, spacing});
        }
    }
}

void FreeRims::finish() {
    if (!edges_.empty()) {
        split(0, static_cast<std::uint32_t>(edges_.size()));
    }
}

void FreeRims::split(std::uint32_t begin, std::uint32_t end) {
    const auto here = nodes_.size();
    Node& node = nodes_.emplace_back(Node{{}, begin, end, 0});
    for (std::uint32_t i = begin; i < end; ++i) {
        Box3 box;
        box.extend(edges_[i].from);
        box.extend(edges_[i].to);
        box = box.grown(edges_[i].spacing);
        node.box.extend(box.lo);
        node.box.extend(box.hi);
    }
    if (end - begin <= leaf_size) {
        return;
    }
    const Vec3 size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(
        edges_.begin() + begin, edges_.begin() + middle, edges_.begin() + end,
        [axis](const Edge& a, const Edge& b) { return a.from[axis] + a.to[axis] < b.from[axis] + b.to[axis]; });
    split(begin, middle);
    nodes_[here].right = static_cast<std::uint32_t>(nodes_.size());
    split(middle, end);
}

double FreeRims::clearance(const Vec3& a, const Vec3& b) const {
    double least = 1;
    if (nodes_.empty()) {
        return least;
    }
    const Sight sight(a, b);
    std::array<std::uint32_t, 64> stack;  // depth of a tree of halves
    std::size_t waiting = 0;
    stack[waiting++] = 0;
    while (waiting > 0) {
        const std::uint32_t at = stack[--waiting];
        const Node& node = nodes_[at];
        if (sight.misses(node.box)) {
            continue;
        }
        if (node.right != 0) {
            stack[waiting++] = node.right;
            stack[waiting++] = at + 1;
            continue;
        }
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const Edge& edge = edges_[i];
            least = std::min(least, segment_distance(a, b, edge.from, edge.to) / edge.spacing);
        }
    }
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
