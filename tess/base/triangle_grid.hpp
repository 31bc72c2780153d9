// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which triangles are near a point, answered in constant time. A hash grid whose cells list the triangles
/// that come within their reach of the cell; a point far from everything meets no cell.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

using TriangleCorners = std::array<Vec3, 3>;

class TriangleGrid {
  public:
    TriangleGrid() = default;

    /// `reach[i]` is the distance up to which triangle i must be found. About 20 list entries a triangle while the
    /// triangles are no larger than their reach; the cells grow when they are, so memory stays linear.
    TriangleGrid(std::vector<TriangleCorners> triangles, std::span<const double> reach);

    /// Every triangle nearer to p than its reach, and some that are not, ascending.
    [[nodiscard]] std::span<const std::uint32_t> candidates(const Vec3& p) const;

    [[nodiscard]] const TriangleCorners& triangle(std::uint32_t i) const { return triangles_[i]; }
    [[nodiscard]] std::size_t size() const { return triangles_.size(); }

    /// Squared distance from p to the triangle.
    [[nodiscard]] double squared_distance_to(std::uint32_t i, const Vec3& p) const;

  private:
    struct Slot {
        std::uint64_t key = unused;
        std::uint32_t begin = 0;
        std::uint32_t count = 0;
    };
    static constexpr std::uint64_t unused = ~std::uint64_t{0};

    /// Calls visit(key) for each cell that comes within reach of the triangle.
    template <class Visit>
    void for_each_cell(const TriangleCorners& triangle, double reach, Visit&& visit) const;
    [[nodiscard]] std::size_t slot_of(std::uint64_t key) const;
    Slot& occupy(std::uint64_t key);
    void grow();

    std::vector<TriangleCorners> triangles_;
    Box3 box_;
    double cell_ = 0;
    std::vector<Slot> slots_;  ///< open addressing, a power of two
    std::size_t occupied_ = 0;
    std::vector<std::uint32_t> entries_;
};

}  // namespace terratet
