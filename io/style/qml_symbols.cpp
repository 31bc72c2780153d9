// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/style/qml_symbols.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "io/style/markup.hpp"

namespace terratet {
namespace {

using Properties = std::vector<std::pair<std::string, std::string>>;

std::string rgba(const Color& color, double opacity = 1) {
    const auto byte = [](double component) { return std::lround(255 * component); };
    return fmt::format("{},{},{},{}", byte(color.r), byte(color.g), byte(color.b), byte(opacity));
}

std::string number(double value) {
    return fmt::format("{:g}", value);
}

std::string layer(const char* kind, const Properties& properties, const std::string& inner = {}) {
    std::string text = fmt::format(R"(<layer class="{}" enabled="1" locked="0" pass="0">)", kind);
    for (const auto& [key, value] : properties) {
        text += fmt::format(R"(<prop k="{}" v="{}"/>)", key, markup_text(value));
    }
    return text + inner + "</layer>";
}

std::string symbol(const char* type, const std::string& name, const std::string& layers) {
    return fmt::format(R"(<symbol type="{}" name="{}" alpha="1" clip_to_extent="1" force_rhr="0">{}</symbol>)", type,
                       markup_text(name), layers);
}

std::string disc(const Color& color, double size) {
    return layer("SimpleMarker", {{"name", "circle"},
                                  {"color", rgba(color)},
                                  {"size", number(size)},
                                  {"size_unit", "MM"},
                                  {"outline_style", "no"}});
}

/// Hollow, so that what lies at its middle is seen.
std::string ring(const Color& color, double size, double width) {
    return layer("SimpleMarker", {{"name", "circle"},
                                  {"color", rgba(color, 0)},
                                  {"size", number(size)},
                                  {"size_unit", "MM"},
                                  {"outline_color", rgba(color)},
                                  {"outline_style", "solid"},
                                  {"outline_width", number(width)},
                                  {"outline_width_unit", "MM"}});
}

}  // namespace

std::string qml_marker(const std::string& name, const Color& color, double size) {
    return symbol("marker", name, disc(color, size));
}

std::string qml_path(const std::string& name, const Color& color, double width) {
    const std::string line = layer("SimpleLine", {{"line_color", rgba(color)},
                                                  {"line_width", number(width)},
                                                  {"line_width_unit", "MM"},
                                                  {"line_style", "solid"},
                                                  {"capstyle", "round"},
                                                  {"joinstyle", "round"}});
    const std::string begin =
        layer("GeometryGenerator", {{"SymbolType", "Marker"}, {"geometryModifier", "start_point($geometry)"}},
              symbol("marker", "@" + name + "@1", ring(color, 7 * width, width)));
    return symbol("line", name, line + begin);
}

std::string qml_fill(const std::string& name, const Color& color, double opacity, double edge_width) {
    return symbol("fill", name,
                  layer("SimpleFill", {{"color", rgba(color, opacity)},
                                       {"style", opacity > 0 ? "solid" : "no"},
                                       {"outline_color", rgba(color, opacity > 0 ? 0.6 : 1)},
                                       {"outline_style", "solid"},
                                       {"outline_width", number(edge_width)},
                                       {"outline_width_unit", "MM"},
                                       {"joinstyle", "round"}}));
}

std::string qml_outline(const std::string& name, const Color& color, double width) {
    return qml_fill(name, color, 0, width);
}

}  // namespace terratet
