// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene/coloring.hpp"

#include <algorithm>
#include <cmath>

#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// 1, 2 or 5 times a power of ten, for four to eight ticks.
double tick_step(double span) {
    const double rough = span / 6;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    for (const double digit : {1.0, 2.0, 5.0}) {
        if (rough <= digit * power) {
            return digit * power;
        }
    }
    return 10 * power;
}

std::vector<double> linear_ticks(const ColorRange& range) {
    std::vector<double> values;
    const double step = tick_step(range.high - range.low);
    for (double k = std::ceil(range.low / step - 1e-9); k * step <= range.high + 1e-9 * step; ++k) {
        values.push_back(k * step + 0.0);
    }
    return values;
}

std::vector<double> decade_ticks(const ColorRange& range) {
    const double decades = range.high - range.low;
    if (decades < 0.7) {
        return linear_ticks({std::pow(10, range.low), std::pow(10, range.high)});
    }
    std::vector<double> values;
    const int every = std::max(1, static_cast<int>(std::ceil(decades / 8)));
    const bool between = decades < 3;
    for (int whole = static_cast<int>(std::floor(range.low)); whole <= range.high; ++whole) {
        const double d = whole;
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double exponent = d + std::log10(digit);
            const bool wanted = digit == 1 ? std::fmod(d, every) == 0 : between;
            if (wanted && exponent >= range.low - 1e-9 && exponent <= range.high + 1e-9) {
                values.push_back(digit * std::pow(10, d));
            }
        }
    }
    return values;
}

}  // namespace

std::vector<LegendTick> legend_ticks(const Property& property, const ColorRange& range) {
    std::vector<LegendTick> ticks;
    if (!(range.high > range.low)) {
        const double value = from_scale(property, range.low);
        return {{value, 0.5, number_text(value)}};
    }
    const bool log = property.scale == Scale::log10;
    for (const double value : log ? decade_ticks(range) : linear_ticks(range)) {
        const double fraction = (to_scale(property, value) - range.low) / (range.high - range.low);
        ticks.push_back({value, std::clamp(fraction, 0.0, 1.0), number_text(value)});
    }
    return ticks;
}

Coloring::Coloring(const ModelView& view, const std::string& property, const std::string& map)
    : map_(ColorMap::named(map)), map_name_(map) {
    const auto& properties = view.model.properties;
    for (std::size_t p = 0; p < properties.size(); ++p) {
        if (property_ == nullptr && (property.empty() || properties[p].name == property)) {
            property_ = &properties[p];
            index_ = p;
        }
    }
    if (property_ == nullptr) {
        if (!property.empty()) {
            const auto names = names_of(properties, &Property::name);
            throw UsageError("no property '" + property + "' to colour by; there are: " + listed(names) +
                             did_you_mean(property, names));
        }
        return;
    }
    range_ = color_range(view.model, index_);
}

double Coloring::low() const {
    return from_scale(*property_, range_.low);
}
double Coloring::high() const {
    return from_scale(*property_, range_.high);
}

Color Coloring::at(double measured) const {
    const double s = to_scale(*property_, measured);
    if (!std::isfinite(s)) {
        return missing_color;
    }
    if (categorical()) {
        return class_color(static_cast<std::size_t>(std::max(0.0, s)));
    }
    return map_.at(range_.high > range_.low ? (s - range_.low) / (range_.high - range_.low) : 0.5);
}

}  // namespace terratet
