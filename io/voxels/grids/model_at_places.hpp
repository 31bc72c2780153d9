// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model's values at somebody else's places, whatever their coordinate system.

#include <string>
#include <vector>

#include "interp/model_estimator.hpp"
#include "tess/barrier/query/model_bounds.hpp"
#include "tess/barrier_query.hpp"
#include "tess/model.hpp"

namespace terratet {

class ModelAtPlaces {
  public:
    /// \param crs_wkt  of the places; empty: the model's
    /// \pre model, barriers and estimator outlive it. Throws InputError when PROJ knows no way between the systems.
    ModelAtPlaces(const Model& model, const BarrierQuery& barriers, const ModelEstimator& estimator,
                  std::string crs_wkt, double max_extrapolation);

    /// What `query value` says at each place: NaN beyond the extent, the ground or the domain; the properties, but not
    /// the extrapolation, where that exceeds `max_extrapolation`.
    [[nodiscard]] ValueBatch values(std::vector<Vec3> places) const;

  private:
    const Model& model_;
    const ModelEstimator& estimator_;
    ModelBounds bounds_;
    std::string crs_wkt_;  ///< empty: the model's
    double max_extrapolation_;
};

}  // namespace terratet
