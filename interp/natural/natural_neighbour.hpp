// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Natural neighbour weights in 3D, computed from the conflict zone of the query in a read-only, cache-line-per-cell
/// copy of the sites' Delaunay tessellation: nothing is inserted, so queries are const and parallel.
///
/// Sibson (1981): the weight of site p is the share of the query's Voronoi cell that would be taken from p's.
/// Laplace (Christ, Friedberg and Lee 1982; Belikov et al. 1997): the area of the face that the query's cell would
/// share with p's, over their distance. stolen_volumes.hpp has the formulas. Either's weights are never negative, so
/// that an estimate lies within the range of its neighbours' values; they reproduce linear fields; on a site they are
/// that site alone. Sibson's estimate has continuous gradients but at the sites, Laplace's is only continuous.
///
/// Smooth (Sibson 1981, C1): gradients at the sites, estimated from their neighbours (site_gradients.hpp), make the
/// estimate's gradient continuous at the sites as well, and reproduce spherical quadratics (a + b·x + c|x|²) inside.
/// Weights may be negative and estimates leave the values' range. The gradients' part fades with the ghosts' share.
///
/// Eight ghost sites around the sites' box make every query bounded. Their share (Weights::beyond) is left out and the
/// rest renormalised. A place beyond the box has the shares of the nearest place of the box. Where only ghosts are
/// neighbours: the nearest visible site.
///
/// Faults: a neighbour's weight is multiplied by how freely the query sees it (BarrierQuery::openness), 0 where a
/// sheet is in the way, and the rest renormalised; so nothing across a fault counts, and estimates are continuous round
/// a fault's end. When all are hidden, the nearest visible site; when none is visible, no value. What ghosts and hidden
/// sites had is made up for by slopes at the sites (slopes.hpp), so that linear fields are reproduced there too.
///
/// Accuracy: a result is accepted if |Σ wᵢpᵢ − q| ≤ 1e-9·R, R the radius of the sphere around the cell that contains
/// the query, and w ≥ −1e-12 (set to 0 then); otherwise it is recomputed in floats of 113 to 4096 bits, held to 1e-15;
/// where even they fail, or would take too long, Laplace's weights or barycentric coordinates stand in
/// (exact_volumes.hpp). Weights::fallback says so.
///
/// About 3 µs a query among uniform sites, 20 µs between 400 boreholes (docs/benchmarks.md); ~750 bytes a site. Smooth:
/// some times that, and 32 bytes more for each pair of neighbours.

#include <memory>

#include "interp/anisotropy.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/natural/weighting.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

namespace terratet {

struct NaturalNeighbourOptions {
    Weighting weighting = Weighting::sibson;
    bool smooth = false;  ///< \pre only with Sibson's
    Anisotropy anisotropy{};
};

class NaturalNeighbour final : public Estimator {
  public:
    /// \pre as make_estimator's. O(n log n), about 6 µs a site.
    NaturalNeighbour(std::vector<Vec3> sites, const BarrierQuery* barriers, NaturalNeighbourOptions options = {});
    ~NaturalNeighbour() override;

    void weights(std::span<const ValueQuery> queries, std::span<Weights> out) const override;
    [[nodiscard]] std::shared_ptr<const Slopes> slopes(std::vector<std::span<const double>> columns) const override;
    [[nodiscard]] std::unique_ptr<const ChangedPlaces> changes_since(const Estimator& before,
                                                                     const ExchangedSites& sites,
                                                                     const Slopes* slopes_before,
                                                                     const Slopes* slopes) const override;

    /// Bytes held, for the benchmarks.
    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
