// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How QGIS is to draw a layer: documents in QML, as its table layer_styles holds them (QGIS 3.16 and later).

#include <string>
#include <vector>

#include "io/style/color_map.hpp"
#include "io/style/color_range.hpp"

namespace terratet {

/// What people are told of a column.
struct ColumnLabel {
    std::string column;
    std::string title;        ///< instead of the column's name
    std::string description;  ///< a sentence
};

/// One of the ways a layer's features look.
struct StyleRule {
    std::string filter;  ///< in QGIS's language of expressions
    std::string label;   ///< in the legend
    std::string symbol;  ///< qml_symbols.hpp; its name is its place in the list
    bool shown = true;   ///< from the start
};

/// A column's name within an expression, and a text.
std::string qml_column(const std::string& name);
std::string qml_text(const std::string& text);

/// Renderers. Points lie by height, the uppermost on top.
std::string qml_single(const std::string& symbol);
std::string qml_rules(const std::vector<StyleRule>& rules);
/// Points in colours of the map, in ten classes that are equal in the property's scale; what is beyond the range has
/// the first or the last one's. A categorical property: its classes' colours.
/// \param column  of the property
std::string qml_values(const Property& property, const std::string& column, const ColorRange& range,
                       const ColorMap& map, double size);

/// The whole document.
/// \param label_column  names features on the map; empty: nothing does
std::string qml_document(const std::string& renderer, const std::vector<ColumnLabel>& columns,
                         const std::string& label_column = {});

}  // namespace terratet
