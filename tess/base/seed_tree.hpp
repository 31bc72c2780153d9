// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The nearest of many points of any density, by number.

#include <cstdint>
#include <limits>
#include <span>

#include "tess/base/box_tree.hpp"
#include "tess/base/no_index.hpp"
#include "tess/geometry.hpp"

namespace terratet {

class SeedTree {
  public:
    /// \pre The points outlive this.
    explicit SeedTree(std::span<const Vec3> points);

    /// The nearest one that is nearer than `radius`, the first of equals; none when none is.
    [[nodiscard]] std::uint32_t nearest(const Vec3& p, double radius) const;

    [[nodiscard]] const Vec3& point(std::uint32_t i) const { return points_[i]; }

  private:
    std::span<const Vec3> points_;
    BoxTree<std::uint32_t> tree_;
};

}  // namespace terratet
