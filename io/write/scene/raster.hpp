// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Triangles and lines into pixels, by a depth buffer: what it takes to draw a scene without a display.

#include <array>
#include <cstdint>
#include <vector>

#include "io/style/color_map.hpp"
#include "tess/geometry.hpp"

namespace terratet {

/// A corner on the picture: x and y in pixels from the upper left, z the inverse of the distance from the eye's plane,
/// which is linear on the picture.
struct RasterCorner {
    Vec3 at;
    Color color;
};

class Raster {
  public:
    Raster(std::uint32_t width, std::uint32_t height, const Color& background);

    /// Colours are linear in space between the corners. With an opacity below 1 what is behind shines through; draw
    /// such ones last, the farthest first.
    void triangle(const std::array<RasterCorner, 3>& corners, double opacity = 1);

    /// \param width in pixels; lines win over surfaces at the same depth
    void line(const RasterCorner& a, const RasterCorner& b, double width, double opacity = 1);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }

    /// The mean of squares of n × n pixels, as 0xFFRRGGBB, row by row.
    [[nodiscard]] std::vector<std::uint32_t> shrunk(std::uint32_t n) const;

  private:
    void put(std::size_t pixel, float depth, const std::array<float, 3>& color, float opacity);

    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<float> depth_;
    std::vector<std::array<float, 3>> color_;
};

}  // namespace terratet
