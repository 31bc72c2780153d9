// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/write/scene.hpp"

#include <algorithm>
#include <cmath>

#include "tess/error.hpp"

namespace terratet {

SceneFrame::SceneFrame(const Model& model) : frame_(model.frame) {
    const Box3& extent = model.domain.extent;
    const double step = std::pow(10.0, std::floor(std::log10(extent.diagonal() / 100)));
    const Vec3 middle = model.frame.to_world(extent.center());
    for (int axis = 0; axis < 3; ++axis) {
        origin_[axis] = std::round(middle[axis] / step) * step;
    }
    local_origin_ = model.frame.to_local(origin_);
}

Coloring::Coloring(const ModelView& view, const std::string& property, const std::string& map)
    : map_(ColorMap::named(map)), map_name_(map) {
    const auto& properties = view.model.properties;
    std::string names;
    for (std::size_t p = 0; p < properties.size(); ++p) {
        if (!property_ && (property.empty() || properties[p].name == property)) {
            property_ = &properties[p];
            index_ = p;
        }
        names += (names.empty() ? "" : ", ") + properties[p].name;
    }
    if (!property_) {
        if (!property.empty()) {
            throw UsageError("no property '" + property + "' to colour by; there are: " + names);
        }
        return;
    }
    std::vector<double> scaled;
    for (const double value : view.model.vertex_values.values[index_]) {
        if (const double s = to_scale(*property_, value); std::isfinite(s)) {
            scaled.push_back(s);
        }
    }
    std::sort(scaled.begin(), scaled.end());
    if (!scaled.empty()) {
        const auto last = static_cast<double>(scaled.size() - 1);
        low_ = scaled[static_cast<std::size_t>(std::floor(0.02 * last))];
        high_ = scaled[static_cast<std::size_t>(std::ceil(0.98 * last))];
    }
}

double Coloring::low() const {
    return from_scale(*property_, low_);
}
double Coloring::high() const {
    return from_scale(*property_, high_);
}

Color Coloring::at(double measured) const {
    const double s = to_scale(*property_, measured);
    if (!std::isfinite(s)) {
        return missing_color;
    }
    if (categorical()) {
        return class_color(static_cast<std::size_t>(std::max(0.0, s)));
    }
    return map_.at(high_ > low_ ? (s - low_) / (high_ - low_) : 0.5);
}

}  // namespace terratet
