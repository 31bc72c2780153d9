// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Text, boxes and strokes on top of a drawn picture, by Cairo.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/style/color_map.hpp"

namespace terratet {

class Canvas {
  public:
    enum class Align { left, middle, right };

    /// \param pixels 0xFFRRGGBB, row by row
    Canvas(std::vector<std::uint32_t> pixels, std::uint32_t width, std::uint32_t height);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    /// The baseline is at y.
    void text(double x, double y, const std::string& text, double size, const Color& color, Align align = Align::left,
              bool bold = false);
    [[nodiscard]] double text_width(const std::string& text, double size, bool bold = false);
    void box(double x, double y, double width, double height, const Color& color, double opacity = 1);
    void outline(double x, double y, double width, double height, const Color& color);
    void line(double x1, double y1, double x2, double y2, double width, const Color& color);
    void polygon(const std::vector<std::pair<double, double>>& corners, const Color& color);

    /// The picture as a PNG.
    [[nodiscard]] std::string png() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
