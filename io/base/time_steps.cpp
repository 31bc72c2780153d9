// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/time_steps.hpp"

#include <algorithm>
#include <charconv>
#include <chrono>

#include "io/base/parse_number.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr char mark = '@';

}  // namespace

std::string time_of(const std::string& name) {
    const std::size_t at = name.rfind(mark);
    return at == std::string::npos || at == 0 ? std::string() : name.substr(at + 1);
}

std::optional<double> days_since_1970(const std::string& label) {
    int year = 0;
    unsigned month = 0;
    unsigned day = 0;
    const char* const text = label.data();
    const bool shaped = label.size() >= 10 && label[4] == '-' && label[7] == '-';
    if (!shaped || std::from_chars(text, text + 4, year).ptr != text + 4 ||
        std::from_chars(text + 5, text + 7, month).ptr != text + 7 ||
        std::from_chars(text + 8, text + 10, day).ptr != text + 10) {
        return {};
    }
    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)};
    if (!date.ok()) {
        return {};
    }
    return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

std::string time_label(std::string_view text) {
    if (const auto number = parse_number(text)) {
        char digits[32];
        return {digits, std::to_chars(digits, digits + sizeof digits, *number).ptr};
    }
    std::string label(text);
    std::ranges::replace(label, ':', '.');
    return label;
}

bool time_before(const std::string& a, const std::string& b) {
    const auto one = parse_number(a);
    const auto other = parse_number(b);
    if (one && other) {
        return *one < *other;
    }
    return one.has_value() != other.has_value() ? one.has_value() : a < b;
}

std::string name_at(const std::string& property, const std::string& time) {
    return property + mark + time;
}

std::string name_without_time(const std::string& name) {
    const std::string time = time_of(name);
    return time.empty() ? name : name.substr(0, name.size() - time.size() - 1);
}

std::vector<std::string> time_steps(const std::vector<Property>& properties) {
    std::vector<std::string> steps;
    for (const Property& property : properties) {
        if (std::string time = time_of(property.name); !time.empty()) {
            steps.push_back(std::move(time));
        }
    }
    std::ranges::sort(steps, time_before);
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    return steps;
}

std::string require_time(const std::vector<Property>& properties, const std::string& time) {
    std::string label = time_label(time);
    const auto steps = time_steps(properties);
    if (std::ranges::find(steps, label) == steps.end()) {
        throw UsageError("no time '" + time + "'; " +
                         (steps.empty() ? "the model's values do not change with time" : "there are " + listed(steps)) +
                         did_you_mean(time, steps));
    }
    return label;
}

std::vector<std::size_t> properties_at(const std::vector<Property>& properties, const std::string& time) {
    std::vector<std::size_t> result;
    for (std::size_t p = 0; p < properties.size(); ++p) {
        if (const std::string own = time_of(properties[p].name); own.empty() || own == time) {
            result.push_back(p);
        }
    }
    return result;
}

Model model_at(const Model& model, const std::string& time) {
    Model result = model;
    result.properties.clear();
    result.vertex_values.values.clear();
    result.samples.values.clear();
    result.samples.censored.clear();
    for (const std::size_t p : properties_at(model.properties, time)) {
        result.properties.push_back(model.properties[p]);
        result.properties.back().name = name_without_time(model.properties[p].name);
        result.vertex_values.values.push_back(model.vertex_values.values[p]);
        result.samples.values.push_back(model.samples.values[p]);
        if (!model.samples.censored.empty()) {
            result.samples.censored.push_back(model.samples.censored[p]);
        }
    }
    return result;
}

}  // namespace terratet
