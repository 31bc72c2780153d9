// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace terratet {
namespace {

/// A property of the vertices alone.
struct Derived {
    Property property;
    std::vector<double> values;
};

std::vector<Derived> derived_from(const Property& property, PropertyEstimates& estimates) {
    std::vector<Derived> all;
    const auto add = [&](const std::string& suffix, const std::string& unit, std::vector<double> values) {
        all.push_back({{property.name + suffix, unit, Scale::linear, Kind::continuous, {}}, std::move(values)});
    };
    if (property.kind == Kind::categorical) {
        add("_entropy", "bit", std::move(estimates.entropy));
        for (std::size_t k = 0; k < property.classes.size(); ++k) {
            add("_p_" + property.classes[k], "", std::move(estimates.probability[k]));
        }
    } else {
        const std::string unit = property.scale == Scale::log10 ? "decade" : property.unit;
        add("_sd", unit, std::move(estimates.deviation));
        add("_ci95", unit, std::move(estimates.half_width));
    }
    add("_extrapolation", "", std::move(estimates.extrapolation));
    add("_samples", "", {estimates.samples.begin(), estimates.samples.end()});
    return all;
}

bool has_samples(const Model& model, std::size_t p) {
    const auto& values = model.samples.values[p];
    return !std::all_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
}

bool is_measured(const Model& model, const std::string& name) {
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        if (model.properties[p].name == name && has_samples(model, p)) {
            return true;
        }
    }
    return false;
}

std::vector<Derived> all_derived(const Model& model, std::vector<PropertyEstimates>& estimates) {
    std::vector<Derived> derived;
    for (std::size_t p = 0; p < estimates.size(); ++p) {
        if (has_samples(model, p)) {
            auto of_property = derived_from(model.properties[p], estimates[p]);
            std::move(of_property.begin(), of_property.end(), std::back_inserter(derived));
        }
    }
    for (Derived& one : derived) {
        while (is_measured(model, one.property.name)) {
            one.property.name += "_estimate";  // as query calls its columns then
        }
    }
    return derived;
}

/// Where to put a derived property: in the place of its predecessor, or at the end.
std::size_t place_for(const Property& property, Model& model) {
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        if (model.properties[p].name == property.name && !has_samples(model, p)) {
            return p;
        }
    }
    model.properties.emplace_back();
    model.samples.values.emplace_back(model.samples.size(), missing);
    if (!model.samples.censored.empty()) {
        model.samples.censored.emplace_back(model.samples.size(), Censoring::none);
    }
    model.vertex_values.values.emplace_back();
    return model.properties.size() - 1;
}

}  // namespace

void add_uncertainty(Model& model, const ModelEstimator& estimator) {
    std::vector<ValueQuery> queries;
    for (const Vertex& vertex : model.vertices) {
        queries.push_back({vertex.position, vertex.role == Role::seed ? vertex.owner : -1, vertex.side});
    }
    auto estimates = estimator.estimates(queries);
    for (auto& [property, values] : all_derived(model, estimates)) {
        const std::size_t p = place_for(property, model);
        model.properties[p] = std::move(property);
        model.vertex_values.values[p] = std::move(values);
    }
}

bool has_derived_properties(const Model& model) {
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        if (!has_samples(model, p)) {
            return true;
        }
    }
    return false;
}

ValueBatch estimated_properties(const Model& model, const ModelEstimator& estimator,
                                std::span<const ValueQuery> places) {
    if (!has_derived_properties(model)) {
        return estimator.values(places);
    }
    ValueBatch batch;
    batch.extrapolation.assign(places.size(), -1);  // below any: no value yet
    auto estimates = estimator.estimates(places);
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        batch.values.push_back(estimates[p].value);
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!std::isnan(estimates[p].value[i])) {
                batch.extrapolation[i] = std::max(batch.extrapolation[i], estimates[p].extrapolation[i]);
            }
        }
    }
    for (auto& [property, values] : all_derived(model, estimates)) {
        for (std::size_t p = 0; p < model.properties.size(); ++p) {
            if (model.properties[p].name == property.name && !has_samples(model, p)) {
                batch.values[p] = std::move(values);
            }
        }
    }
    for (double& extrapolation : batch.extrapolation) {
        extrapolation = extrapolation < 0 ? 1 : extrapolation;
    }
    return batch;
}

}  // namespace terratet
