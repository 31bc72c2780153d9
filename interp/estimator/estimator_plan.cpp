// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator_plan.hpp"

#include <algorithm>
#include <string_view>

#include "interp/base/number_text.hpp"
#include "tess/error.hpp"

namespace terratet {

const EstimatorSpec& EstimatorPlan::of(const std::string& property) const {
    const auto found = of_property.find(property);
    return found == of_property.end() ? general : found->second;
}

namespace {

/// A name within a line.
std::string one_line(const std::string& name) {
    std::string text;
    for (const char c : name) {
        text += c == '\n' ? "\\n" : c == '\\' ? "\\\\" : std::string(1, c);
    }
    return text;
}

std::string from_one_line(const std::string& text) {
    std::string name;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escaped = text[i] == '\\' && i + 1 < text.size();
        i += escaped ? 1 : 0;
        name += escaped && text[i] == 'n' ? '\n' : text[i];
    }
    return name;
}

constexpr std::string_view traits_head = "samples:";

std::string text_of(const ColumnTraits& traits) {
    return std::string(traits_head) + "lowest=" + shortest(traits.lowest) + ":highest=" + shortest(traits.highest) +
           ":reach=" + shortest(traits.reach);
}

ColumnTraits parse_traits(const std::string& text) {
    ColumnTraits traits;
    std::size_t at = traits_head.size();
    for (const auto& [key, number] : {std::pair<std::string, double&>("lowest=", traits.lowest),
                                      {"highest=", traits.highest},
                                      {"reach=", traits.reach}}) {
        const std::size_t end = std::min(text.find(':', at), text.size());
        const auto parsed = text.compare(at, key.size(), key) == 0
                                ? number_in(text.substr(at + key.size(), end - at - key.size()))
                                : std::nullopt;
        if (!parsed) {
            throw UsageError("'" + text + "' has no number where '" + key + "' should be");
        }
        number = *parsed;
        at = std::min(end + 1, text.size());
    }
    if (at != text.size() || traits.lowest > traits.highest || traits.reach < 0) {
        throw UsageError("'" + text + "' is nothing that samples can have");
    }
    return traits;
}

}  // namespace

std::string EstimatorPlan::to_string() const {
    std::string text = general.to_string();
    for (const auto& [property, spec] : of_property) {
        text += "\n" + spec.to_string() + " of " + one_line(property);
    }
    for (const auto& [property, known] : traits) {
        text += "\n" + text_of(known) + " of " + one_line(property);
    }
    for (const auto& [property, calibration] : calibrations) {
        text += "\n" + calibration.to_string() + " of " + one_line(property);
    }
    return text;
}

EstimatorPlan parse_estimator_plan(const std::string& text) {
    EstimatorPlan plan;
    if (text.empty()) {
        return plan;
    }
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        const std::size_t of = line.find(" of ");
        begin = end + 1;
        const std::string property = of == std::string::npos ? "" : from_one_line(line.substr(of + 4));
        if (of != std::string::npos && line.starts_with("uncertainty:")) {
            plan.calibrations[property] = parse_calibration(line.substr(0, of));
            continue;
        }
        if (of != std::string::npos && line.starts_with(traits_head)) {
            plan.traits[property] = parse_traits(line.substr(0, of));
            continue;
        }
        const EstimatorSpec spec = parse_estimator(line.substr(0, of));
        if (of == std::string::npos) {
            plan.general = spec;
        } else {
            plan.of_property[property] = spec;
        }
    }
    return plan;
}

}  // namespace terratet
