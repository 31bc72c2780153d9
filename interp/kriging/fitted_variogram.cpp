// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/kriging/fitted_variogram.hpp"

#include <vector>

#include "interp/kriging/kriging_spec.hpp"
#include "interp/kriging/kriging_system.hpp"
#include "interp/base/number_text.hpp"

namespace terratet {

VariogramFit fit_variogram(const EstimatorSpec& spec, std::span<const Vec3> places, std::span<const double> values,
                           std::span<const std::int32_t> boreholes, Kind kind, std::size_t most_samples) {
    VariogramRequest request;
    if (spec.name == "kriging") {
        request = {family_of(spec),     spec.number("nu"),    spec.given("nugget"), spec.given("sill"),
                   spec.given("range"), spec.given("ratio3"), anisotropy_of(spec)};
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

EstimatorSpec with_fitted_variogram(const EstimatorSpec& spec, std::span<const Vec3> places,
                                    std::span<const double> values, std::span<const std::int32_t> boreholes, Kind kind,
                                    std::size_t most_samples) {
    if (!needs_values(spec)) {
        return spec;
    }
    const Variogram fit = fit_variogram(spec, places, values, boreholes, kind, most_samples).variogram;
    EstimatorSpec complete = spec;
    complete.options["nugget"] = shortest(fit.nugget);
    complete.options["sill"] = shortest(fit.sill);
    complete.options["range"] = shortest(fit.range);
    complete.options["ratio3"] = shortest(fit.anisotropy.ratio3);
    return complete;
}

}  // namespace terratet
