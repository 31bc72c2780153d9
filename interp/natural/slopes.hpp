// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What makes estimates from natural neighbours, Laplace's and linear in cells reproduce linear fields where a part of
/// the weights is gone: neighbours that a fault hides, and the ghosts beyond the samples (site_mesh.hpp).
///
/// Without that part the weighted centroid of the sites lies away from the query, by the lever (Weights::lever); so it
/// does where gradients of natural:smooth are not determined. The mean of gradients at the sites, with the remaining
/// weights, times the lever makes up for it: whatever the weights, linear fields come out exactly, and as the gradients
/// belong to the sites the estimate is as continuous as the weights are.
///
/// A site's gradient is fitted by least squares to the differences zⱼ − zᵢ of what the site sees around it
/// (surroundings.hpp), each counted by openness over distance. Along axes that nothing determines the slope is 0: the
/// plane of least slope. All in the coordinates of the estimator's anisotropy.
///
/// Fitted when first needed, once a site, from the site's surroundings alone: const, reentrant, and the same whatever
/// was asked before. 56 bytes a site and 32 more for each column, for those that were needed.

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "interp/estimator/estimator.hpp"
#include "interp/sites/sheet_sides.hpp"
#include "interp/sites/site_mesh.hpp"
#include "interp/sites/stars.hpp"

namespace terratet {

class Slopes {
  public:
    /// \param columns  values at the sites, by the numbers the caller knows them by, all finite; they and `sites` must
    ///                 outlive this
    Slopes(const SiteMesh& sites, std::vector<std::span<const double>> columns);

    struct Part {
        double value = 0;
        double variance = 0;  ///< of the gradients, by the scatter about their planes
    };

    /// The weighted mean of a column's gradients times the lever. O(terms) once they are fitted.
    [[nodiscard]] Part along_lever(std::size_t column, const Weights& weights) const;

    /// Takes over what `before` has fitted and nothing has touched since. Before anything is asked of this.
    /// \param before_of  of each of the caller's sites its number in `before`; −1: none
    /// \param touched    sites that came, left, or have other neighbours than before, in the tessellation's coordinates
    /// \returns those fitted in `before` that are others here, by the numbers of its tessellation, ascending
    std::vector<std::int32_t> take_over(const Slopes& before, std::span<const std::int64_t> before_of,
                                        std::span<const Vec3> touched) const;
    /// Of all sites; made when first asked for.
    [[nodiscard]] const Stars& stars() const;

  private:
    struct Slope {
        Vec3 gradient;
        double scatter;  ///< variance about the plane
        friend bool operator==(const Slope&, const Slope&) = default;
    };
    /// Variance of the gradient for a scatter of 1: the symmetric matrix's xx, yy, zz, xy, xz, yz.
    using Shape = std::array<double, 6>;

    struct Fitted {
        const Shape& shape;
        const Slope& slope;
    };
    Fitted at(std::uint32_t site, std::size_t column) const;
    /// \returns Surroundings::squared_reach
    double fit(std::int32_t site, Shape& shape, std::span<Slope> slopes) const;

    const SiteMesh& sites_;
    SheetSides sides_;
    std::vector<std::span<const double>> columns_;
    std::vector<std::int32_t> vertex_of_;  ///< of each of the caller's sites
    mutable std::once_flag stars_wanted_;
    mutable std::unique_ptr<const Stars> stars_;
    std::unique_ptr<std::atomic<std::uint8_t>[]> states_;
    std::unique_ptr<Shape[]> shapes_;            ///< of each site
    std::unique_ptr<Slope[]> slopes_;            ///< of each site, by column
    std::unique_ptr<double[]> squared_reaches_;  ///< of each site
};

}  // namespace terratet
