// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/kriging/kriging_spec.hpp"

#include <limits>

namespace terratet {

Neighbourhood neighbourhood_of(const EstimatorSpec& spec) {
    return {static_cast<std::size_t>(spec.number("max_points")),
            spec.given("radius").value_or(std::numeric_limits<double>::infinity()),
            static_cast<std::uint32_t>(spec.number("per_octant")),
            static_cast<std::uint32_t>(spec.number("per_borehole"))};
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
    return {{family_of(spec), spec.number("nu"), *spec.given("nugget"), *spec.given("sill"), *spec.given("range"),
             anisotropy_of(spec)},
            drift_of(spec),
            neighbourhood_of(spec)};
}

std::optional<double> range_of(const EstimatorSpec& spec) {
    return spec.name == "kriging" ? std::optional(kriging_options(spec).variogram.practical_range()) : std::nullopt;
}

}  // namespace terratet
