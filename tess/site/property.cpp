// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/property.hpp"

#include <cmath>
#include <limits>
#include <sstream>

#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {

double to_scale(const Property& property, double value) {
    if (property.scale == Scale::linear || property.kind == Kind::categorical) {
        return value;
    }
    return value > 0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
}

double from_scale(const Property& property, double scaled) {
    return property.scale == Scale::linear || property.kind == Kind::categorical ? scaled : std::pow(10.0, scaled);
}

double scaled_difference(const Property& property, double a, double b) {
    if (std::isnan(a) || std::isnan(b)) {
        return 0;
    }
    if (property.kind == Kind::categorical) {
        return a == b ? 0 : std::numeric_limits<double>::infinity();
    }
    const double difference = std::abs(to_scale(property, a) - to_scale(property, b));
    return std::isnan(difference) ? 0 : difference;
}

Property parse_property(const std::string& text) {
    Property property;
    std::istringstream parts(text);
    std::getline(parts, property.name, ':');
    if (property.name.empty()) {
        throw UsageError("property '" + text + "' has no name; write NAME[:log10][:categorical][:unit=U]");
    }
    std::string part;
    while (std::getline(parts, part, ':')) {
        if (part == "log10") {
            property.scale = Scale::log10;
        } else if (part == "linear") {
            property.scale = Scale::linear;
        } else if (part == "categorical") {
            property.kind = Kind::categorical;
        } else if (part.starts_with("unit=")) {
            property.unit = part.substr(5);
        } else {
            throw UsageError("property '" + text + "': '" + part +
                             "' is not known; write NAME[:log10][:categorical][:unit=U]" +
                             did_you_mean(part, {"log10", "linear", "categorical", "unit="}));
        }
    }
    if (property.kind == Kind::categorical && property.scale == Scale::log10) {
        throw UsageError("property '" + text + "': a category has no logarithm; leave out log10 or categorical");
    }
    return property;
}

}  // namespace terratet
