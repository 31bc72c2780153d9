// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Colours for values: perceptually ordered maps for quantities, a palette for classes, grey for what is missing.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace terratet {

/// Components in sRGB (as in a style sheet), 0…1.
struct Color {
    double r = 0;
    double g = 0;
    double b = 0;
};

/// "#1f9e89"
std::string hex(const Color& color);

/// As glTF wants it in COLOR_0: linear, eight bits each, opaque.
std::array<std::uint8_t, 4> to_linear_rgba8(const Color& color);

/// From sRGB's transfer function to linear light (IEC 61966-2-1).
double to_linear(double component);

inline constexpr Color missing_color{0.62, 0.62, 0.62};

class ColorMap {
  public:
    /// viridis, cividis, plasma, magma, inferno (van der Walt, Smith 2015; Nuñez et al. 2018) or grey. Throws
    /// UsageError that lists them.
    static ColorMap named(const std::string& name);

    /// Of all there are.
    static std::vector<std::string> names();
    [[nodiscard]] const std::vector<Color>& anchors() const { return anchors_; }  ///< evenly apart, 0 to 1

    /// t is clamped to 0…1; between the map's anchors interpolated in sRGB.
    [[nodiscard]] Color at(double t) const;

  private:
    explicit ColorMap(std::vector<Color> anchors) : anchors_(std::move(anchors)) {}
    std::vector<Color> anchors_;
};

/// The colour of class i: eight that the colour-blind can tell apart (Okabe, Ito 2008), then hues the golden angle
/// apart.
Color class_color(std::size_t index);

}  // namespace terratet
