// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator_spec.hpp"

#include <algorithm>
#include <cmath>

#include "interp/base/number_text.hpp"
#include "interp/estimator/estimator_catalogue.hpp"
#include "tess/base/words.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

bool valid(const EstimatorOption& option, const std::string& value) {
    if (!option.words.empty()) {
        return std::find(option.words.begin(), option.words.end(), value) != option.words.end();
    }
    const auto parsed = number_in(value);
    return parsed && *parsed >= option.lowest && *parsed <= option.highest &&
           (!option.above || *parsed > option.lowest) && (!option.whole || *parsed == std::floor(*parsed));
}

void add_option(EstimatorSpec& spec, const EstimatorMethod& method, const std::string& part) {
    const auto equals = part.find('=');
    const std::string key = part.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
    const auto option = std::find_if(method.options.begin(), method.options.end(),
                                     [&](const EstimatorOption& candidate) { return candidate.name == key; });
    if (option == method.options.end()) {
        const auto known = names_of(method.options, &EstimatorOption::name);
        throw UsageError("estimator '" + method.name + "' has no option '" + key + "'; it has " + listed(known) +
                         did_you_mean(key, known));
    }
    if (option->flag ? equals != std::string::npos : !valid(*option, value)) {
        throw UsageError(
            "estimator '" + method.name + "': " +
            (option->flag ? key + " takes no value"
                          : key + "='" + value + "' is not " + wanted(*option) + did_you_mean(value, option->words)));
    }
    if (!spec.options.emplace(key, value).second) {
        throw UsageError("estimator '" + method.name + "': " + key + " is given twice");
    }
}

}  // namespace

std::string EstimatorSpec::to_string() const {
    std::string text = name;
    for (const auto& option : estimator_method(name).options) {
        const auto given = options.find(option.name);
        if (option.flag) {
            text += given == options.end() ? "" : ":" + option.name;
            continue;
        }
        const std::string& value = given == options.end() ? option.default_value : given->second;
        if (!value.empty() && !(option.implied && given == options.end())) {
            text += ":" + option.name + "=" + value;
        }
    }
    return text;
}

std::string EstimatorSpec::as_given() const {
    std::string text = name;
    for (const auto& option : estimator_method(name).options) {
        if (const auto found = options.find(option.name); found != options.end()) {
            text += ":" + option.name + (option.flag ? "" : "=" + found->second);
        }
    }
    return text;
}

std::optional<double> EstimatorSpec::given(const std::string& key) const {
    const auto found = options.find(key);
    return found == options.end() ? std::nullopt : number_in(found->second);
}

double EstimatorSpec::number(const std::string& key) const {
    for (const auto& option : estimator_method(name).options) {
        if (option.name == key) {
            const auto own = given(key);
            return own ? *own : number_in(option.default_value).value_or(0);
        }
    }
    return 0;
}

EstimatorSpec parse_estimator(const std::string& text) {
    EstimatorSpec spec;
    spec.name = text.substr(0, text.find(':'));
    const EstimatorMethod& method = estimator_method(spec.name);
    for (std::size_t at = spec.name.size(); at < text.size();) {
        const std::size_t end = std::min(text.find(':', at + 1), text.size());
        add_option(spec, method, text.substr(at + 1, end - at - 1));
        at = end;
    }
    return spec;
}

Anisotropy anisotropy_of(const EstimatorSpec& spec) {
    return {spec.number("azimuth"), spec.number("dip"), spec.number("roll"), spec.number("ratio2"),
            spec.number("ratio3")};
}

bool needs_values(const EstimatorSpec& spec) {
    const auto open = [&](const char* key) { return !spec.options.contains(key); };
    return spec.name == "kriging" && (open("nugget") || open("sill") || open("range") || open("ratio3"));
}

}  // namespace terratet
