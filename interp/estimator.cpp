// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string_view>

#include "interp/estimator_catalogue.hpp"
#include "interp/idw.hpp"
#include "interp/kriging.hpp"
#include "interp/kriging_drift.hpp"
#include "interp/linear.hpp"
#include "interp/natural_neighbour.hpp"
#include "interp/nearest.hpp"
#include "interp/number_text.hpp"
#include "interp/variogram_fit.hpp"
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
        std::string known;
        for (const auto& candidate : method.options) {
            known += (known.empty() ? "" : ", ") + candidate.name;
        }
        throw UsageError("estimator '" + method.name + "' has no option '" + key + "'; it has " +
                         (known.empty() ? "none" : known));
    }
    if (option->flag ? equals != std::string::npos : !valid(*option, value)) {
        throw UsageError("estimator '" + method.name + "': " +
                         (option->flag ? key + " takes no value" : key + "='" + value + "' is not " + wanted(*option)));
    }
    if (!spec.options.emplace(key, value).second) {
        throw UsageError("estimator '" + method.name + "': " + key + " is given twice");
    }
}

double value_of(const EstimatorSpec& spec, const std::string& key, double otherwise) {
    const auto found = spec.options.find(key);
    return found == spec.options.end() ? otherwise : number_in(found->second).value_or(otherwise);
}

/// The number of an option as given, else its default.
double value_of(const EstimatorSpec& spec, const std::string& key) {
    for (const auto& option : estimator_method(spec.name).options) {
        if (option.name == key) {
            return value_of(spec, key, number_in(option.default_value).value_or(0));
        }
    }
    return 0;
}

Neighbourhood neighbourhood_of(const EstimatorSpec& spec) {
    return {static_cast<std::size_t>(value_of(spec, "max_points")),
            value_of(spec, "radius", std::numeric_limits<double>::infinity()),
            static_cast<std::uint32_t>(value_of(spec, "per_octant")),
            static_cast<std::uint32_t>(value_of(spec, "per_borehole"))};
}

std::optional<double> given(const EstimatorSpec& spec, const std::string& key) {
    const auto found = spec.options.find(key);
    return found == spec.options.end() ? std::nullopt : number_in(found->second);
}

VariogramFamily family_of(const EstimatorSpec& spec) {
    const auto found = spec.options.find("model");
    return found == spec.options.end() ? VariogramFamily::spherical : variogram_family(found->second);
}

Drift drift_of(const EstimatorSpec& spec) {
    const auto found = spec.options.find("drift");
    return found != spec.options.end() && found->second == "linear" ? Drift::linear : Drift::constant;
}

KrigingOptions kriging_options(const EstimatorSpec& spec) {
    return {{family_of(spec), value_of(spec, "nu"), *given(spec, "nugget"), *given(spec, "sill"), *given(spec, "range"),
             anisotropy_of(spec)},
            drift_of(spec),
            neighbourhood_of(spec)};
}

}  // namespace

std::shared_ptr<const Slopes> Estimator::slopes(std::vector<std::span<const double>>) const {
    return nullptr;
}

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
    return {value_of(spec, "azimuth"), value_of(spec, "dip"), value_of(spec, "roll"), value_of(spec, "ratio2"),
            value_of(spec, "ratio3")};
}

std::optional<double> range_of(const EstimatorSpec& spec) {
    return spec.name == "kriging" ? std::optional(kriging_options(spec).variogram.practical_range()) : std::nullopt;
}

std::unique_ptr<Estimator> make_estimator(const EstimatorSpec& spec, std::vector<Vec3> sites,
                                          const FaultProximity* faults, std::vector<std::int32_t> boreholes) {
    const std::string& name = estimator_method(spec.name).name;
    if (name == "nearest") {
        return std::make_unique<Nearest>(std::move(sites), faults, anisotropy_of(spec));
    }
    if (name == "kriging") {
        assert(!needs_values(spec));
        return std::make_unique<Kriging>(std::move(sites), faults, kriging_options(spec), boreholes);
    }
    if (name == "idw") {
        return std::make_unique<InverseDistance>(
            std::move(sites), faults, IdwOptions{value_of(spec, "power"), neighbourhood_of(spec), anisotropy_of(spec)},
            std::move(boreholes));
    }
    if (name == "linear") {
        return std::make_unique<LinearInCells>(std::move(sites), faults, anisotropy_of(spec));
    }
    NaturalNeighbourOptions options;
    options.weighting =
        name == "laplace" ? NaturalNeighbourOptions::Weighting::laplace : NaturalNeighbourOptions::Weighting::sibson;
    options.smooth = spec.options.contains("smooth");
    options.anisotropy = anisotropy_of(spec);
    return std::make_unique<NaturalNeighbour>(std::move(sites), faults, options);
}

bool needs_values(const EstimatorSpec& spec) {
    const auto open = [&](const char* key) { return !spec.options.contains(key); };
    return spec.name == "kriging" && (open("nugget") || open("sill") || open("range") || open("ratio3"));
}

VariogramFit fit_variogram(const EstimatorSpec& spec, std::span<const Vec3> places, std::span<const double> values,
                           std::span<const std::int32_t> boreholes, Kind kind, std::size_t most_samples) {
    VariogramRequest request;
    if (spec.name == "kriging") {
        request = {family_of(spec),      value_of(spec, "nu"),  given(spec, "nugget"), given(spec, "sill"),
                   given(spec, "range"), given(spec, "ratio3"), anisotropy_of(spec)};
        request.anisotropy.ratio3 = 1;
        const auto fit = spec.options.find("fit");
        request.robust = fit == spec.options.end() || fit->second == "robust";
    }
    request.categorical = kind == Kind::categorical;
    request.most_samples = most_samples;
    std::vector<double> detrended;
    if (drift_of(spec) == Drift::linear && kind == Kind::continuous) {
        detrended = without_linear_trend(places, values);
        values = detrended;
    }
    return fit_variogram(places, values, boreholes, request);
}

EstimatorSpec fitted_estimator(const EstimatorSpec& spec, std::span<const Vec3> sites, std::span<const double> values,
                               std::span<const std::int32_t> boreholes, Kind kind, const FaultProximity* faults,
                               std::size_t most_samples) {
    if (!needs_values(spec)) {
        return spec;
    }
    EstimatorSpec complete = spec;
    if (!spec.options.contains("drift") && kind == Kind::continuous) {
        complete.options["drift"] = better_drift(spec, sites, values, boreholes, faults);
    }
    const Variogram fit = fit_variogram(complete, sites, values, boreholes, kind, most_samples).variogram;
    complete.options["nugget"] = shortest(fit.nugget);
    complete.options["sill"] = shortest(fit.sill);
    complete.options["range"] = shortest(fit.range);
    complete.options["ratio3"] = shortest(fit.anisotropy.ratio3);
    return complete;
}

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
