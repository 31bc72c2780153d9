// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Linear interpolation in the cells of the samples' own Delaunay tessellation: the barycentric coordinates of the
/// query in the cell that contains it. Continuous, with kinks at the facets; linear fields are reproduced inside the
/// hull.
///
/// Ghosts, faults, slopes and fallbacks as in natural_neighbour.hpp; so there are at most four terms, and where
/// all four samples are hidden the nearest visible one counts. About 1 µs a query; ~750 bytes a site.

#include "interp/anisotropy.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/sites/site_mesh.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

namespace terratet {

class LinearInCells final : public Estimator {
  public:
    /// \pre as make_estimator's. O(n log n), about 6 µs a site.
    LinearInCells(std::vector<Vec3> sites, const BarrierQuery* barriers, const Anisotropy& anisotropy = {});

    void weights(std::span<const ValueQuery> queries, std::span<Weights> out) const override;
    [[nodiscard]] std::shared_ptr<const Slopes> slopes(std::vector<std::span<const double>> columns) const override;
    [[nodiscard]] std::unique_ptr<const ChangedPlaces> changes_since(const Estimator& before,
                                                                     const ExchangedSites& sites,
                                                                     const Slopes* slopes_before,
                                                                     const Slopes* slopes) const override;

  private:
    void estimate(const Vec3& place, std::int32_t& start, Weights& out) const;

    SiteMesh sites_;
};

}  // namespace terratet
