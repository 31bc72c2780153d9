// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Sibson weights by other ways than the library's: CGAL's own function, and the definition in rational numbers.

#include <memory>
#include <vector>

#include "interp/estimator/estimator.hpp"

namespace terratet::testing {

using SiteWeights = std::vector<SiteWeight>;

/// CGAL::sibson_natural_neighbor_coordinates_3, normalised. \pre places lie well inside the hull
std::vector<SiteWeights> cgal_sibson_weights(const std::vector<Vec3>& sites, const std::vector<Vec3>& places);

/// CGAL::laplace_natural_neighbor_coordinates_3, normalised. \pre places lie well inside the hull
std::vector<SiteWeights> cgal_laplace_weights(const std::vector<Vec3>& sites, const std::vector<Vec3>& places);

/// Barycentric coordinates in the cell that CGAL's walk ends in. \pre places lie inside the hull
std::vector<SiteWeights> cgal_linear_weights(const std::vector<Vec3>& sites, const std::vector<Vec3>& places);

/// Voronoi cells and their exact volumes. Its own eight far sites make cells bounded; where they have no share, the
/// weights are those of the sites alone.
class ExactVoronoi {
  public:
    explicit ExactVoronoi(const std::vector<Vec3>& sites);
    ~ExactVoronoi();

    /// By definition: what each cell loses when q is inserted, over what q gains. Seconds for hundreds of neighbours.
    [[nodiscard]] SiteWeights sibson_weights(const Vec3& q) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The library's fallbacks, which estimates hardly ever take. None where they give up.
enum class Fallback { long_doubles, wide, precise };
SiteWeights fallback_weights(const std::vector<Vec3>& sites, const Vec3& q, Fallback which);

/// Over the sites of either; a site that is missing weighs 0.
double largest_difference(const SiteWeights& a, const SiteWeights& b);

}  // namespace terratet::testing
