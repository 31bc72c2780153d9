// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Natural neighbour weights in 3D (Sibson 1981), computed from the conflict zone of the query in a read-only,
/// cache-line-per-cell copy of the sites' Delaunay tessellation: nothing is inserted, so queries are const and
/// parallel.
///
/// The weight of site p is the share of the query's Voronoi cell that would be taken from p's (stolen_volumes.hpp has
/// the formula). Weights are never negative, so that an estimate lies within the range of its neighbours' values; they
/// reproduce linear fields; on a site they are that site alone.
///
/// Eight ghost sites, three diameters outside, make every query bounded. Their share is the extrapolation; the rest is
/// renormalised. Beyond the ghosts, or where only ghosts are neighbours: the nearest visible site, extrapolation 1.
///
/// Faults: neighbours behind a fault are dropped and the rest renormalised; when all are hidden, the nearest visible
/// site; when none is visible, no value.
///
/// Accuracy: a result is accepted if |Σ wᵢpᵢ − q| ≤ 1e-9·R, R the radius of the sphere around the cell that contains
/// the query, and w ≥ −1e-12 (set to 0 then); otherwise it is recomputed in rational numbers. Weights::fallback says
/// so.
///
/// About 3 µs a query among uniform sites, 20 µs between 400 boreholes (docs/benchmarks.md); ~700 bytes a site.

#include <memory>

#include "interp/estimator.hpp"

namespace terratet {

class NaturalNeighbour final : public Estimator {
  public:
    /// \pre as make_estimator's. O(n log n), about 6 µs a site.
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
