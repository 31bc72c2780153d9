// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/style/color_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr Color from_hex(std::uint32_t rgb) {
    return {static_cast<double>(rgb >> 16) / 255, static_cast<double>(rgb >> 8 & 0xFF) / 255,
            static_cast<double>(rgb & 0xFF) / 255};
}

struct NamedMap {
    const char* name;
    std::array<std::uint32_t, 10> anchors;  ///< at 0, 1/9, … 1
};

constexpr NamedMap maps[] = {
    {"viridis", {0x440154, 0x482878, 0x3E4989, 0x31688E, 0x26828E, 0x1F9E89, 0x35B779, 0x6ECE58, 0xB5DE2B, 0xFDE725}},
    {"cividis", {0x00224E, 0x123570, 0x3B496C, 0x575D6D, 0x707173, 0x8A8678, 0xA59C74, 0xC3B369, 0xE1CC55, 0xFEE838}},
    {"plasma", {0x0D0887, 0x46039F, 0x7201A8, 0x9C179E, 0xBD3786, 0xD8576B, 0xED7953, 0xFB9F3A, 0xFDCA26, 0xF0F921}},
    {"magma", {0x000004, 0x180F3D, 0x440F76, 0x721F81, 0x9E2F7F, 0xCD4071, 0xF1605D, 0xFD9668, 0xFECA8D, 0xFCFDBF}},
    {"inferno", {0x000004, 0x1B0C41, 0x4A0C6B, 0x781C6D, 0xA52C60, 0xCF4446, 0xED6925, 0xFB9B06, 0xF7D13D, 0xFCFFA4}},
    {"grey", {0x1A1A1A, 0x313131, 0x484848, 0x5F5F5F, 0x777777, 0x8E8E8E, 0xA5A5A5, 0xBCBCBC, 0xD3D3D3, 0xEAEAEA}},
};

constexpr std::uint32_t palette[] = {0xE69F00, 0x56B4E9, 0x009E73, 0xF0E442, 0x0072B2, 0xD55E00, 0xCC79A7, 0x4D4D4D};

/// Hue 0…1 at fixed saturation and value.
Color from_hue(double hue) {
    const auto component = [hue](double offset) {
        const double h = std::fmod(hue + offset, 1.0) * 6;
        return 0.85 - 0.5 * std::clamp(std::min(h, 4 - h), 0.0, 1.0);
    };
    return {component(5.0 / 6), component(3.0 / 6), component(1.0 / 6)};
}

}  // namespace

std::string hex(const Color& color) {
    char text[8];
    const auto byte = [](double c) { return static_cast<unsigned>(std::lround(255 * std::clamp(c, 0.0, 1.0))); };
    std::snprintf(text, sizeof text, "#%02x%02x%02x", byte(color.r) & 0xFF, byte(color.g) & 0xFF, byte(color.b) & 0xFF);
    return text;
}

double to_linear(double component) {
    return component <= 0.04045 ? component / 12.92 : std::pow((component + 0.055) / 1.055, 2.4);
}

std::array<std::uint8_t, 4> to_linear_rgba8(const Color& color) {
    const auto byte = [](double c) { return static_cast<std::uint8_t>(std::lround(255 * to_linear(c))); };
    return {byte(color.r), byte(color.g), byte(color.b), 255};
}

ColorMap ColorMap::named(const std::string& name) {
    for (const NamedMap& map : maps) {
        if (name == map.name) {
            std::vector<Color> anchors;
            for (const std::uint32_t rgb : map.anchors) {
                anchors.push_back(from_hex(rgb));
            }
            return ColorMap(std::move(anchors));
        }
    }
    throw UsageError("unknown colour map '" + name + "'; there are " + listed(names()) + did_you_mean(name, names()));
}

std::vector<std::string> ColorMap::names() {
    return names_of(maps, &NamedMap::name);
}

Color ColorMap::at(double t) const {
    const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(anchors_.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(place), anchors_.size() - 2);
    const double f = place - static_cast<double>(i);
    const Color& a = anchors_[i];
    const Color& b = anchors_[i + 1];
    return {a.r + f * (b.r - a.r), a.g + f * (b.g - a.g), a.b + f * (b.b - a.b)};
}

Color class_color(std::size_t index) {
    constexpr double golden_angle = 0.38196601125010515;
    return index < std::size(palette) ? from_hex(palette[index])
                                      : from_hue(std::fmod(static_cast<double>(index) * golden_angle, 1.0));
}

}  // namespace terratet
