// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The protection zone of prepared faults, asked very often: the same places as
/// BarrierQuery::protecting_fault, but what one question costs hardly grows where triangles are small and many.

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/base/tri_mesh.hpp"

namespace terratet {

class ProtectionZone {
  public:
    explicit ProtectionZone(std::span<const Barrier> barriers);

    /// Nearer to a triangle of a sheet or margin than its protection radius?
    [[nodiscard]] bool contains(const Vec3& p) const;

    /// A place out of it near p, which is p if that is; none if the way out is not found in a few steps.
    [[nodiscard]] std::optional<Vec3> pushed_out(Vec3 p) const;

    /// The smallest radius; infinity when nothing is protected.
    [[nodiscard]] double narrowest() const { return narrowest_; }

    struct Ball {  ///< what is kept about a triangle
        TriangleCorners corners{};
        double radius = 0;
        std::uint32_t barrier = 0;
        bool sheet = true;  ///< or margin
    };
    /// Is the test true of one of those whose triangle is nearer to p than that? Asked until it is.
    template <class Test>
    [[nodiscard]] bool any_near(const Vec3& p, double distance, const Test& test) const {
        return visit([&](const Node& node) { return squared_distance(p, node.box.clamped(p)) < distance * distance; },
                     test);
    }

  private:
    struct Node {
        Box3 box;
        double radius = 0;  ///< the largest below
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint32_t right = 0;  ///< the second child; the first follows at once; 0: a leaf
    };
    static constexpr std::size_t deepest = 64;  // more than a tree of halves
    void split(std::uint32_t begin, std::uint32_t end);

    /// Is the test true of one below the nodes that are wanted?
    template <class Wanted, class Test>
    [[nodiscard]] bool visit(const Wanted& wanted, const Test& test) const {
        std::array<std::uint32_t, deepest> waiting{};
        std::size_t count = nodes_.empty() ? 0 : 1;
        while (count > 0) {
            const std::uint32_t at = waiting[--count];
            const Node& node = nodes_[at];
            if (!wanted(node)) {
                continue;
            }
            if (node.right != 0) {
                waiting[count++] = node.right;
                waiting[count++] = at + 1;
                continue;
            }
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                if (test(balls_[i])) {
                    return true;
                }
            }
        }
        return false;
    }

    double narrowest_ = std::numeric_limits<double>::infinity();
    std::vector<Ball> balls_;
    std::vector<Node> nodes_;
};

}  // namespace terratet
