// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Inverse distance weighting (Shepard 1968) over the nearest visible sites: wᵢ ∝ 1 / dᵢ^power. On a site, that site
/// alone. The extrapolation is 0 everywhere: the method knows no inside. O(max_points log n).

#include "interp/anisotropy.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/sites/site_index.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

namespace terratet {

struct IdwOptions {
    double power = 2;
    Neighbourhood neighbourhood{};
    Anisotropy anisotropy{};
};

class InverseDistance final : public Estimator {
  public:
    InverseDistance(std::vector<Vec3> sites, const BarrierQuery* barriers, const IdwOptions& options,
                    std::span<const std::int32_t> boreholes = {});

    void weights(std::span<const ValueQuery> queries, std::span<Weights> out) const override;

  private:
    std::vector<Vec3> sites_;
    SiteIndex index_;
    IdwOptions options_;
};

}  // namespace terratet
