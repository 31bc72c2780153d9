// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Does a segment meet a surface? A tree of boxes, and exact predicates at its leaves. Estimators ask this
/// for every neighbour of every place; CGAL's AABB tree, whose boxes are tested in interval arithmetic too, takes five
/// times as long.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "tess/geometry.hpp"

namespace terratet {

class TriangleTree {
  public:
    /// Triangles without area are left out. O(n log n).
    TriangleTree(std::span<const Vec3> points, std::span<const Triangle> triangles);
    TriangleTree() : TriangleTree({}, {}) {}
    ~TriangleTree();
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;

    /// Does the closed segment, or the point where a == b, meet a closed triangle? Exact. O(log n).
    [[nodiscard]] bool meets(const Vec3& a, const Vec3& b) const;

    /// Of all triangles by their areas, of length 1; 0 without any.
    [[nodiscard]] Vec3 mean_normal() const;

    /// To the nearest triangle; infinity without any. O(log n).
    [[nodiscard]] double distance_to(const Vec3& p) const;

    /// The point of the surface nearest to p; none without any triangle. O(log n).
    [[nodiscard]] std::optional<Vec3> nearest_to(const Vec3& p) const;

    /// The sum of the unit normals of the triangles that hold p; zero where none does. Exact in which these are.
    [[nodiscard]] Vec3 normal_at(const Vec3& p) const;

    /// On which side is p: +1 where the normals point, −1, or 0 on the surface? Told by the exact orientation to a
    /// triangle that nothing of the surface hides from p. Beyond a rim the surface is thought to go on. 0 without any
    /// triangle. O(log n).
    [[nodiscard]] std::int8_t side_of(const Vec3& p) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
