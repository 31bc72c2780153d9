// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/tolerance_option.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/base/parse_number.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"
#include "tess/model/tolerance.hpp"

namespace terratet::tools {
/// "P=T", "P=N%", "N%" or "auto".
AskedTolerance parse_tolerance(const std::string& text) {
    if (text == "auto") {
        return {.automatic = true};
    }
    const auto equals = text.rfind('=');
    std::string number = equals == std::string::npos ? text : text.substr(equals + 1);
    AskedTolerance asked;
    asked.property = equals == std::string::npos ? "" : text.substr(0, equals);
    asked.percent = number.ends_with('%');
    number.resize(number.size() - (asked.percent ? 1 : 0));
    const auto value = parse_number(number);
    if (!value || equals == 0 || (equals == std::string::npos && !asked.percent)) {
        throw UsageError(
            fmt::format("'{}' is not PROPERTY=NUMBER, such as CU=0.1, PROPERTY=10%, 10% for all, or auto{}", text,
                        did_you_mean(text, {"auto"})));
    }
    if (!(*value > 0) || !std::isfinite(*value)) {
        throw UsageError(fmt::format("'{}' is not above 0", text));
    }
    asked.value = *value;
    return asked;
}

std::vector<Property>::const_iterator find_property(const std::string& option, const std::string& name,
                                                    const std::vector<Property>& properties) {
    const auto found = std::ranges::find(properties, name, &Property::name);
    if (found == properties.end()) {
        const auto known = names_of(properties, &Property::name);
        throw UsageError(fmt::format("{}: there is no property '{}'; there is {}{}", option, name, listed(known),
                                     did_you_mean(name, known)));
    }
    return found;
}

void set_tolerances(const std::vector<AskedTolerance>& tolerances, const Site& site, Criteria& criteria) {
    for (const AskedTolerance& asked : tolerances) {
        if (asked.automatic) {
            continue;
        }
        if (!asked.property.empty()) {
            const auto found = find_property("--tolerance", asked.property, site.properties);
            if (found->kind == Kind::categorical) {
                throw UsageError(
                    fmt::format("--tolerance: {} is a category; its classes differ or do not", asked.property));
            }
        }
        criteria.variation.resize(site.properties.size());
        for (std::size_t p = 0; p < site.properties.size(); ++p) {
            const Property& property = site.properties[p];
            if (property.kind == Kind::continuous && (asked.property.empty() || asked.property == property.name)) {
                criteria.variation[p].tolerance =
                    asked.percent ? tolerance_of_range(property, site.samples.values[p], asked.value) : asked.value;
            }
        }
    }
}

}  // namespace terratet::tools
