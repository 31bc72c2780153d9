// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "interp/idw.hpp"
#include "interp/natural_neighbour.hpp"
#include "interp/nearest.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

struct Option {
    std::string name;
    std::string default_value;  ///< empty: none
    std::string wanted;         ///< what a value must be, for messages
    bool (*valid)(double);
};

struct Method {
    std::string name;
    std::vector<Option> options;  ///< in the order they are written
};

const std::vector<Method>& methods() {
    static const std::vector<Method> all = {
        {"nearest", {}},
        {"idw",
         {{"power", "2", "a number from 0 to 100", [](double v) { return v >= 0 && v <= 100; }},
          {"radius", "", "a positive length", [](double v) { return v > 0; }},
          {"max_points", "12", "a whole number from 1 to 100000",
           [](double v) { return v >= 1 && v <= 100'000 && v == std::floor(v); }}}},
        {"natural", {}},
    };
    return all;
}

template <typename Items>
std::string listed(const Items& items) {
    std::string text;
    for (const auto& item : items) {
        text += (text.empty() ? "" : ", ") + item.name;
    }
    return text;
}

const Method& method_named(const std::string& name) {
    const auto found =
        std::find_if(methods().begin(), methods().end(), [&](const Method& method) { return method.name == name; });
    if (found == methods().end()) {
        throw UsageError("estimator '" + name + "' is not known; there are " + listed(methods()));
    }
    return *found;
}

std::optional<double> number(const std::string& text) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

void add_option(EstimatorSpec& spec, const Method& method, const std::string& part) {
    const auto equals = part.find('=');
    const std::string key = part.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
    const auto option = std::find_if(method.options.begin(), method.options.end(),
                                     [&](const Option& candidate) { return candidate.name == key; });
    if (option == method.options.end()) {
        throw UsageError("estimator '" + method.name + "' has no option '" + key + "'; it has " +
                         (method.options.empty() ? "none" : listed(method.options)));
    }
    const auto parsed = number(value);
    if (!parsed || !option->valid(*parsed)) {
        throw UsageError("estimator '" + method.name + "': " + key + "='" + value + "' is not " + option->wanted);
    }
    if (!spec.options.emplace(key, value).second) {
        throw UsageError("estimator '" + method.name + "': " + key + " is given twice");
    }
}

double value_of(const EstimatorSpec& spec, const std::string& key, double otherwise) {
    const auto found = spec.options.find(key);
    return found == spec.options.end() ? otherwise : number(found->second).value_or(otherwise);
}

IdwOptions idw_options(const EstimatorSpec& spec) {
    IdwOptions options;
    options.power = value_of(spec, "power", options.power);
    options.radius = value_of(spec, "radius", options.radius);
    options.max_points =
        static_cast<std::size_t>(value_of(spec, "max_points", static_cast<double>(options.max_points)));
    return options;
}

}  // namespace

std::string EstimatorSpec::to_string() const {
    std::string text = name;
    for (const auto& option : method_named(name).options) {
        const auto given = options.find(option.name);
        const std::string& value = given == options.end() ? option.default_value : given->second;
        if (!value.empty()) {
            text += ":" + option.name + "=" + value;
        }
    }
    return text;
}

EstimatorSpec parse_estimator(const std::string& text) {
    EstimatorSpec spec;
    spec.name = text.substr(0, text.find(':'));
    const Method& method = method_named(spec.name);
    for (std::size_t at = spec.name.size(); at < text.size();) {
        const std::size_t end = std::min(text.find(':', at + 1), text.size());
        add_option(spec, method, text.substr(at + 1, end - at - 1));
        at = end;
    }
    return spec;
}

std::unique_ptr<Estimator> make_estimator(const EstimatorSpec& spec, std::vector<Vec3> sites,
                                          const FaultProximity* faults, std::vector<std::int32_t> /*boreholes*/) {
    const Method& method = method_named(spec.name);
    if (method.name == "nearest") {
        return std::make_unique<Nearest>(std::move(sites), faults);
    }
    if (method.name == "idw") {
        return std::make_unique<InverseDistance>(std::move(sites), faults, idw_options(spec));
    }
    return std::make_unique<NaturalNeighbour>(std::move(sites), faults);
}

}  // namespace terratet
