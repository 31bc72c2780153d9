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
    std::vector<Ball> balls;
    for (std::size_t f = 0; f < barriers.size(); ++f) {
        const std::vector<double> radii = protection_radii(barriers, f);
        auto radius = radii.begin();
        for (const Surface* part : {&barriers[f].sheet, &barriers[f].margin}) {
            for (const Triangle& t : part->triangles) {
                balls.push_back({{part->vertices[t[0]], part->vertices[t[1]], part->vertices[t[2]]},
                                 *radius++,
                                 static_cast<std::uint32_t>(f),
                                 part == &barriers[f].sheet});
            }
        }
    }
    for (const Ball& ball : balls) {
        narrowest_ = std::min(narrowest_, ball.radius);
    }
    tree_ = {std::move(balls), leaf_size,
             [](auto& node, const Ball& ball) {
                 for (const Vec3& p : ball.corners) {
                     node.box.extend(p);
                 }
                 node.more.radius = std::max(node.more.radius, ball.radius);
             },
             [](const Ball& ball, int axis) {
                 return ball.corners[0][axis] + ball.corners[1][axis] + ball.corners[2][axis];
             }};
}

bool ProtectionZone::contains(const Vec3& p) const {
    return tree_.any(
        [&](const auto& node) {
            return squared_distance(p, node.box.clamped(p)) < node.more.radius * node.more.radius;
        },
        [&](const Ball& ball) {
            const auto& c = ball.corners;
            return squared_distance(p, closest_point_on_triangle(p, c[0], c[1], c[2])) < ball.radius * ball.radius;
        });
}

/// Away from the triangle whose zone it is deepest in, again and again.
std::optional<Vec3> ProtectionZone::pushed_out(Vec3 p) const {
    for (int step = 0; step < most_steps; ++step) {
        double deepest_in = 0;
        Vec3 next;
        static_cast<void>(tree_.any(
            [&](const auto& node) {
                const double reach = node.more.radius - deepest_in;
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
