// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Inverse distance weighting (Shepard 1968) over the nearest visible sites: wᵢ ∝ 1 / dᵢ^power. On a site, that site
/// alone. The extrapolation is 0 everywhere: the method knows no inside. O(max_points log n).

#include <cstddef>
#include <limits>

#include "interp/estimator.hpp"
#include "interp/site_index.hpp"

namespace terratet {

struct IdwOptions {
    double power = 2;
    double radius = std::numeric_limits<double>::infinity();  ///< sites farther away do not count; none left: no value
    std::size_t max_points = 12;
};

class InverseDistance final : public Estimator {
  public:
    InverseDistance(std::vector<Vec3> sites, const FaultProximity* faults, const IdwOptions& options);

    void weights(std::span<const ValueQuery> queries, std::span<Weights> out) const override;

  private:
    std::vector<Vec3> sites_;
    SiteIndex index_;
    IdwOptions options_;
};

}  // namespace terratet
