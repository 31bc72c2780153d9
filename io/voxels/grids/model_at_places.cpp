// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/grids/model_at_places.hpp"

#include <limits>
#include <utility>

#include "interp/plan/uncertainty.hpp"
#include "io/base/crs.hpp"

namespace terratet {

ModelAtPlaces::ModelAtPlaces(const Model& model, const BarrierQuery& barriers, const ModelEstimator& estimator,
                             std::string crs_wkt, double max_extrapolation)
    : model_(model),
      estimator_(estimator),
      bounds_(model.domain, barriers),
      crs_wkt_(crs_wkt == model.frame.crs_wkt ? "" : std::move(crs_wkt)),
      max_extrapolation_(max_extrapolation) {
    if (!crs_wkt_.empty()) {
        static_cast<void>(CrsTransform(crs_from_wkt(crs_wkt_), crs_from_wkt(model.frame.crs_wkt)));
    }
}

ValueBatch ModelAtPlaces::values(std::vector<Vec3> places) const {
    if (!crs_wkt_.empty()) {
        CrsTransform(crs_from_wkt(crs_wkt_), crs_from_wkt(model_.frame.crs_wkt)).apply(places);
    }
    std::vector<ValueQuery> queries;
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Vec3 place = model_.frame.to_local(places[i]);
        if (is_finite(place) && model_.domain.extent.contains(place) && !bounds_.excludes(place)) {
            queries.push_back({place, -1, 1});
            asked.push_back(i);
        }
    }
    ValueBatch result;
    result.values.assign(model_.properties.size(), std::vector<double>(places.size(), missing));
    result.extrapolation.assign(places.size(), missing);
    if (queries.empty()) {
        return result;
    }
    const ValueBatch found = estimated_properties(model_, estimator_, queries);
    for (std::size_t q = 0; q < queries.size(); ++q) {
        const double reach = found.extrapolation[q];
        result.extrapolation[asked[q]] = reach;
        for (std::size_t p = 0; reach <= max_extrapolation_ && p < result.values.size(); ++p) {
            result.values[p][asked[q]] = found.values[p][q];
        }
    }
    return result;
}

}  // namespace terratet
