// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Natural neighbour weights in 3D (Sibson 1981), computed from the conflict zone of the query in a read-only,
/// cache-line-per-cell copy of the sites' Delaunay tessellation: nothing is inserted, so queries are const and parallel.
///
/// The weight of site p is the share of the query's Voronoi cell that would be taken from p's. With the query at the
/// origin, each dual edge x = c₁ × c₂ of the cavity contributes x·(a+b)/2 to the sites a, b whose common face it bounds;
/// no division but in the circumcentres of the cavity's boundary facets.
///
/// Eight ghost sites far outside make every query bounded; their share is the extrapolation.
///
/// Accuracy: results are accepted if |Σ wᵢpᵢ − q| ≤ 1e-9·R, w ≥ −1e-12 and the volumes agree; otherwise they are
/// recomputed with exact arithmetic and counted as fallbacks.

#include <memory>

#include "interp/estimator.hpp"

namespace terratet {

class NaturalNeighbour final : public Estimator {
  public:
    NaturalNeighbour(std::vector<Vec3> sites, const FaultProximity* faults);
    ~NaturalNeighbour() override;

    void weights(std::span<const ValueQuery> queries, std::span<Weights> out) const override;

    /// Bytes held, for the benchmarks.
    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
