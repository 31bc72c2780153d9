// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Is a place in one of many balls? A regular grid over a box knows which balls reach into each of its bins, and which
/// bins lie in one ball altogether.

#include <array>
#include <cstdint>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

struct Ball {
    Vec3 center;
    double squared_radius;
};

class BallBins {
  public:
    /// Balls are closed, and a hair larger than they say: what is on one's boundary but for rounding counts as in it.
    BallBins(const Box3& box, std::vector<Ball> balls);

    /// \pre p is in the box
    [[nodiscard]] bool contains(const Vec3& p) const;

  private:
    static constexpr std::uint32_t whole = 1;  ///< state of a bin inside a ball; 0: touched by none; else its list + 2

    void add(std::uint32_t ball);
    [[nodiscard]] std::int32_t bin_of(int axis, double at) const;

    Box3 box_;
    std::array<std::int32_t, 3> bins_{};
    std::array<double, 3> edge_{};  ///< of a bin; 0 along an axis without extent
    std::vector<Ball> balls_;
    std::vector<std::uint32_t> states_;
    std::vector<std::vector<std::uint32_t>> lists_;
};

}  // namespace terratet
