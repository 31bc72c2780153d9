// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fault_zone.hpp"

#include <algorithm>
#include <array>

#include "tess/fault_approach.hpp"

namespace terratet {
namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr std::size_t deepest = 64;  // more than a tree of halves

}  // namespace

FaultZone::FaultZone(std::span<const Fault> faults) {
    for (std::size_t f = 0; f < faults.size(); ++f) {
        const std::vector<double> radii = protection_radii(faults, f);
        auto radius = radii.begin();
        for (const Surface* part : {&faults[f].sheet, &faults[f].margin}) {
            for (const Triangle& t : part->triangles) {
                balls_.push_back({{part->vertices[t[0]], part->vertices[t[1]], part->vertices[t[2]]}, *radius++});
            }
        }
    }
    if (!balls_.empty()) {
        split(0, static_cast<std::uint32_t>(balls_.size()));
    }
}

void FaultZone::split(std::uint32_t begin, std::uint32_t end) {
    const auto here = nodes_.size();
    Node node{{}, 0, begin, end, 0};
    for (std::uint32_t i = begin; i < end; ++i) {
        for (const Vec3& p : balls_[i].corners) {
            node.box.extend(p);
        }
        node.radius = std::max(node.radius, balls_[i].radius);
    }
    nodes_.push_back(node);
    if (end - begin <= leaf_size) {
        return;
    }
    const Vec3 size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto key = [axis](const Ball& ball) {
        return ball.corners[0][axis] + ball.corners[1][axis] + ball.corners[2][axis];
    };
    std::nth_element(balls_.begin() + begin, balls_.begin() + middle, balls_.begin() + end,
                     [&](const Ball& a, const Ball& b) { return key(a) < key(b); });
    split(begin, middle);
    nodes_[here].right = static_cast<std::uint32_t>(nodes_.size());
    split(middle, end);
}

bool FaultZone::contains(const Vec3& p) const {
    std::array<std::uint32_t, deepest> waiting{};
    std::size_t count = nodes_.empty() ? 0 : 1;
    while (count > 0) {
        const std::uint32_t at = waiting[--count];
        const Node& node = nodes_[at];
        if (squared_distance(p, node.box.clamped(p)) >= node.radius * node.radius) {
            continue;
        }
        if (node.right != 0) {
            waiting[count++] = node.right;
            waiting[count++] = at + 1;
            continue;
        }
        for (std::uint32_t i = node.begin; i < node.end; ++i) {
            const auto& [c, radius] = balls_[i];
            if (squared_distance(p, closest_point_on_triangle(p, c[0], c[1], c[2])) < radius * radius) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace terratet
