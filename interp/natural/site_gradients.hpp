// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Gradients at the sites as linear functions of the values: ∇ᵢ = Σⱼ Gᵢⱼ (zⱼ − zᵢ) over i's natural neighbours j.
///
/// Weighted least squares of zᵢ + ∇ᵢ·(pⱼ − pᵢ) against zⱼ. Sibson (1981) weighs with λᵢⱼ/d², λ his coordinates of pᵢ
/// among the other sites. Here λᵢⱼ is the area of the Voronoi face of i and j over their distance d: it needs no
/// removal of pᵢ and has the property that matters, Σⱼ λᵢⱼ (pⱼ − pᵢ) = 0 (a closed surface), by which gradients of
/// spherical quadratics are exact inside the hull. Neighbours count as far as they can be seen. A direction in which
/// the nearest neighbours hardly extend (those in the same straight hole), or extend only to one at nearly the same
/// place (a twin hole, a hair apart and of other values), would make noise a slope: where differences of values counted
/// more than thirtyfold over the distance of the fifth nearest, weights are 1/d instead, and where that does not help
/// there is no slope.

#include <cstdint>
#include <span>
#include <vector>

#include "interp/sites/site_mesh.hpp"

namespace terratet {

class SiteGradients {
  public:
    struct Term {
        std::int32_t neighbour;
        Vec3 factor;  ///< Gᵢⱼ
    };

    /// In parallel. O(n) times the neighbours a site has.
    explicit SiteGradients(const SiteMesh& sites);

    /// Of one site, in the tessellation's numbers.
    [[nodiscard]] std::span<const Term> of(std::int32_t site) const {
        const auto i = static_cast<std::size_t>(site);
        return std::span(terms_).subspan(begin_[i], begin_[i + 1] - begin_[i]);
    }
    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    std::vector<Term> terms_;
    std::vector<std::size_t> begin_;  ///< of each site's terms, and the end
};

}  // namespace terratet
