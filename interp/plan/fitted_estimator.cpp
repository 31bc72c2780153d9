// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/fitted_estimator.hpp"

#include "interp/kriging/fitted_variogram.hpp"
#include "interp/plan/kriging_drift.hpp"

namespace terratet {

EstimatorSpec fitted_estimator(const EstimatorSpec& spec, std::span<const Vec3> sites, std::span<const double> values,
                               std::span<const std::int32_t> boreholes, Kind kind, const BarrierQuery* barriers,
                               std::size_t most_samples) {
    if (!needs_values(spec)) {
        return spec;
    }
    EstimatorSpec complete = spec;
    if (!spec.options.contains("drift") && kind == Kind::continuous) {
        complete.options["drift"] = better_drift(spec, sites, values, boreholes, barriers);
    }
    return with_fitted_variogram(complete, sites, values, boreholes, kind, most_samples);
}

}  // namespace terratet
