// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Symbols of QGIS as QML, the language of its styles. Sizes are millimetres on the map.

#include <string>

#include "io/style/color_map.hpp"

namespace terratet {

/// A disc.
std::string qml_marker(const std::string& name, const Color& color, double size);

/// A line, and where it begins (a borehole's collar) a ring: a vertical hole is no more than that in plan.
std::string qml_path(const std::string& name, const Color& color, double width);

/// Areas, `opacity` 0…1, with an edge of their colour: an upright surface is no more than that in plan.
std::string qml_fill(const std::string& name, const Color& color, double opacity, double edge_width);

/// An edge alone.
std::string qml_outline(const std::string& name, const Color& color, double width);

}  // namespace terratet
