// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Kriging in local neighbourhoods: the linear unbiased estimate of least variance for a variogram, ordinary (an
/// unknown constant mean) or universal (an unknown linear trend). The variance is the kriging variance of a new
/// measurement, nugget included; on a site 0, since the site's value comes back.
///
/// Weights::beyond is the weight of the mean: an estimate is Σλz + (1 − Σλ)·m with the weights λ of simple kriging,
/// and beyond the variogram's range from all samples nothing but the mean m is left.
///
/// Systems that can't be solved as they are (nearly singular; a drift that collinear samples don't determine) are
/// solved with a nugget of 1e-8 of the variance or without the drift, at worst replaced by inverse squared distances;
/// Weights::fallback says so. Weights are always finite and sum to 1.
///
/// About 10 µs an estimate from 24 samples, 65 bytes a site (docs/benchmarks.md).

#include "interp/estimator/estimator.hpp"
#include "interp/kriging/kriging_system.hpp"
#include "interp/sites/site_index.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

namespace terratet {

struct KrigingOptions {
    Variogram variogram;
    Drift drift = Drift::constant;
    Neighbourhood neighbourhood{.max_points = 24, .per_octant = 4, .per_borehole = 8};
};

class Kriging final : public Estimator {
  public:
    /// Distances of the neighbourhood are those of the variogram's anisotropy.
    Kriging(std::vector<Vec3> sites, const BarrierQuery* barriers, const KrigingOptions& options,
            std::span<const std::int32_t> boreholes = {});

    void weights(std::span<const ValueQuery> queries, std::span<Weights> out) const override;
    [[nodiscard]] bool has_variance() const override { return true; }

    /// Bytes held, for the benchmarks.
    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    std::vector<Vec3> sites_;
    SiteIndex index_;
    KrigingOptions options_;
};

}  // namespace terratet
