// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator_plan.hpp"

#include <algorithm>
#include <initializer_list>
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
constexpr std::string_view choice_head = "chosen:";

/// `HEADkey=number:…`, all of it.
void parse_numbers(const std::string& text, std::string_view head,
                   std::initializer_list<std::pair<std::string, double&>> numbers) {
    std::size_t at = head.size();
    for (const auto& [key, number] : numbers) {
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
    if (at != text.size()) {
        throw UsageError("'" + text + "' goes on where it should end");
    }
}

std::string text_of(const ColumnTraits& traits) {
    return std::string(traits_head) + "lowest=" + shortest(traits.lowest) + ":highest=" + shortest(traits.highest) +
           ":reach=" + shortest(traits.reach);
}

ColumnTraits parse_traits(const std::string& text) {
    ColumnTraits traits;
    parse_numbers(text, traits_head,
                  {{"lowest=", traits.lowest}, {"highest=", traits.highest}, {"reach=", traits.reach}});
    if (traits.lowest > traits.highest || traits.reach < 0) {
        throw UsageError("'" + text + "' is nothing that samples can have");
    }
    return traits;
}

std::string text_of(const EstimatorChoice& choice) {
    return std::string(choice_head) + "rms=" + shortest(choice.rms) + ":plain=" + shortest(choice.rms_plain) +
           ":better=" + std::to_string(choice.better_folds) + ":folds=" + std::to_string(choice.folds);
}

EstimatorChoice parse_choice(const std::string& text) {
    EstimatorChoice choice;
    double better = 0;
    double folds = 0;
    parse_numbers(text, choice_head,
                  {{"rms=", choice.rms}, {"plain=", choice.rms_plain}, {"better=", better}, {"folds=", folds}});
    if (choice.rms < 0 || choice.rms_plain < 0 || better < 0 || better > folds || folds > 1000) {
        throw UsageError("'" + text + "' is nothing that a choice can be");
    }
    choice.better_folds = static_cast<std::size_t>(better);
    choice.folds = static_cast<std::size_t>(folds);
    return choice;
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
    for (const auto& [property, choice] : choices) {
        text += "\n" + text_of(choice) + " of " + one_line(property);
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
        if (of != std::string::npos && line.starts_with(choice_head)) {
            plan.choices[property] = parse_choice(line.substr(0, of));
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
