// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/style/color_range.hpp"

#include <algorithm>
#include <cmath>

namespace terratet {

ColorRange color_range(const Model& model, std::size_t property) {
    const auto& values = model.vertex_values.values[property];
    const auto& extrapolation = model.vertex_values.extrapolation;
    std::vector<double> near;
    std::vector<double> all;
    for (std::size_t v = 0; v < values.size(); ++v) {
        if (const double s = to_scale(model.properties[property], values[v]); std::isfinite(s)) {
            all.push_back(s);
            if (v < extrapolation.size() && extrapolation[v] < 1) {
                near.push_back(s);
            }
        }
    }
    std::vector<double>& scaled = near.empty() ? all : near;
    if (scaled.empty()) {
        return {};
    }
    std::sort(scaled.begin(), scaled.end());
    const auto last = static_cast<double>(scaled.size() - 1);
    return {scaled[static_cast<std::size_t>(std::floor(0.02 * last))],
            scaled[static_cast<std::size_t>(std::ceil(0.98 * last))]};
}

}  // namespace terratet
