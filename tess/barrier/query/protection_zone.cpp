// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/query/protection_zone.hpp"

#include <algorithm>

#include "tess/barrier/query/protection_radii.hpp"

namespace terratet {
namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr int most_steps = 12;
constexpr double beyond = 1 + 1e-5;  ///< of the radius: just out of the zone

}  // namespace

ProtectionZone::ProtectionZone(std::span<const Barrier> barriers) {
    for (std::size_t f = 0; f < barriers.size(); ++f) {
        const std::vector<double> radii = protection_radii(barriers, f);
        auto radius = radii.begin();
        for (const Surface* part : {&barriers[f].sheet, &barriers[f].margin}) {
            for (const Triangle& t : part->triangles) {
                balls_.push_back({{part->vertices[t[0]], part->vertices[t[1]], part->vertices[t[2]]},
                                  *radius++,
                                  static_cast<std::uint32_t>(f),
                                  part == &barriers[f].sheet});
            }
        }
    }
    for (const Ball& ball : balls_) {
        narrowest_ = std::min(narrowest_, ball.radius);
    }
    if (!balls_.empty()) {
        split(0, static_cast<std::uint32_t>(balls_.size()));
    }
}

void ProtectionZone::split(std::uint32_t begin, std::uint32_t end) {
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

bool ProtectionZone::contains(const Vec3& p) const {
    return visit([&](const Node& node) { return squared_distance(p, node.box.clamped(p)) < node.radius * node.radius; },
                 [&](const Ball& ball) {
                     const auto& c = ball.corners;
                     return squared_distance(p, closest_point_on_triangle(p, c[0], c[1], c[2])) <
                            ball.radius * ball.radius;
                 });
}

/// Away from the triangle whose zone it is deepest in, again and again.
std::optional<Vec3> ProtectionZone::pushed_out(Vec3 p) const {
    for (int step = 0; step < most_steps; ++step) {
        double deepest_in = 0;
        Vec3 next;
        static_cast<void>(visit(
            [&](const Node& node) {
                const double reach = node.radius - deepest_in;
                return reach > 0 && squared_distance(p, node.box.clamped(p)) < reach * reach;
            },
            [&](const Ball& ball) {
                const Vec3 foot = closest_point_on_triangle(p, ball.corners[0], ball.corners[1], ball.corners[2]);
                const double away = distance(p, foot);
                if (away > 0 && ball.radius - away > deepest_in) {
                    deepest_in = ball.radius - away;
                    next = foot + beyond * ball.radius / away * (p - foot);
                }
                return false;
            }));
        if (deepest_in <= 0) {
            return contains(p) ? std::nullopt : std::optional(p);
        }
        p = next;
    }
    return std::nullopt;
}

}  // namespace terratet
