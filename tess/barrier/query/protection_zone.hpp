// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The protection zone of prepared faults, asked very often: the same places as
/// BarrierQuery::protecting_fault, but what one question costs hardly grows where triangles are small and many.

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/base/box_tree.hpp"
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
        return tree_.any(
            [&](const auto& node) { return squared_distance(p, node.box.clamped(p)) < distance * distance; }, test);
    }

  private:
    struct Widest {
        double radius = 0;
    };

    double narrowest_ = std::numeric_limits<double>::infinity();
    BoxTree<Ball, Widest> tree_;
};

}  // namespace terratet
