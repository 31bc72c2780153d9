// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The box of points along the principal axes of their spread: how thick they are together, whichever way they lie.

#include <array>
#include <span>

#include "tess/geometry.hpp"

namespace terratet {

class PrincipalBox {
  public:
    /// O(points). \pre not empty, finite
    explicit PrincipalBox(std::span<const Vec3> points);

    /// Unit vectors, that of the least spread first.
    [[nodiscard]] const Vec3& axis(int i) const { return axes_[static_cast<std::size_t>(i)]; }
    [[nodiscard]] double thickness(int i) const { return extent_.hi[i] - extent_.lo[i]; }
    [[nodiscard]] const Vec3& mean() const { return mean_; }

    /// Are the points a plane or a line (or one), but for rounding in a file, in a frame that hides it?
    [[nodiscard]] bool flat_and_tilted() const { return flat_and_tilted_; }

    /// The nearest place of the box; q itself, to the last bit, inside and within rounding.
    [[nodiscard]] Vec3 clamped(const Vec3& q) const;

  private:
    Vec3 mean_;
    std::array<Vec3, 3> axes_;
    Box3 extent_;  ///< about the mean, along the axes
    double tolerance_ = 0;
    bool flat_and_tilted_ = false;
};

}  // namespace terratet
