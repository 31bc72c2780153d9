// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Plain charts as SVG, for reports: points and lines in panels side by side, axes with round numbers.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace terratet {

struct ChartSeries {
    enum class Style : std::uint8_t { dots, circles, line, dashes };
    std::string label;  ///< in the legend; empty: none
    Style style = Style::dots;
    std::vector<std::pair<double, double>> points;  ///< those with a NaN are left out
};

struct Chart {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<ChartSeries> series;
    bool square = false;  ///< the same range on both axes, with the diagonal drawn
    bool from_zero = false;
};

/// A whole SVG file, the charts in rows of three. Dots are thinned to 3000 a series, evenly.
std::string svg_text(const std::vector<Chart>& charts);

/// Writes it whole or not at all. Throws Error as OutputFile does.
void write_svg(const std::vector<Chart>& charts, const std::string& path, bool overwrite);

}  // namespace terratet
