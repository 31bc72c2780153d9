// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A standard deviation for methods that know none, from leaving boreholes out.
///
/// Leaving out sample i with its borehole gives an error eᵢ at a place dᵢ away from the nearest sample that was used;
/// where a part of the weights is hidden (Weights::hidden), farther by that part of the lever.
/// How errors grow with that distance is a profile v(d): their mean squares in up to ten classes of distance, made to
/// rise, straight lines between, from 0 on a sample. How large they are nearby is a rate, eᵢ²/v(dᵢ) averaged over the
/// 32 nearest visible samples; half of it counts, and half of the mean of all, since 32 errors of a borehole or two say
/// little. The variance of an estimate h away from the nearest sample it uses is v(h) times the weighted mean of its
/// samples' rates, at most twice the variance of all values: two independent ones differ by no more. On a sample it is
/// 0.
///
/// It says where errors are larger; how large they are is for calibration.hpp, which wants to know what would have been
/// said of a borehole without having seen its errors: Rates of all folds but one.

#include <span>
#include <vector>

#include "interp/estimator/estimator.hpp"
#include "tess/barrier_query.hpp"

namespace terratet {

class LocalError {
  public:
    /// What the errors tell.
    struct Rates {
        std::vector<double> distance;  ///< of the profile, ascending, above 0; empty: nothing is known
        std::vector<double> variance;  ///< there, not falling
        std::vector<double> near;      ///< around each site, over the profile's; NaN: unknown
    };

    /// \param sites    of the estimator; must outlive this
    /// \param values   at the sites, in the property's scale, all finite
    /// \param fold_of  each site's fold
    LocalError(std::span<const Vec3> sites, std::span<const double> values, std::vector<std::uint32_t> fold_of);

    /// Notes how far off the others' estimate of a site is (folds.hpp); without terms nothing.
    void add(std::uint32_t site, double error, const Weights& left_out);

    /// Learns from what was added. 128 bytes a site meanwhile.
    void pool(const BarrierQuery* barriers, std::size_t count = 32);

    /// As pool() learnt, but from the other folds' errors alone. O(sites · count). \pre pool(), forget() not yet
    [[nodiscard]] Rates without(std::uint32_t fold) const;

    /// Gives the memory of without() back.
    void forget();

    /// Of an estimate with these weights; NaN without terms, or where no sample could be left out. O(terms).
    [[nodiscard]] double standard_deviation(const Vec3& place, const Weights& weights) const {
        return standard_deviation(place, weights, all_);
    }
    [[nodiscard]] double standard_deviation(const Vec3& place, const Weights& weights, const Rates& rates) const;

  private:
    [[nodiscard]] Rates rates(std::uint32_t without) const;

    std::span<const Vec3> sites_;
    std::vector<std::uint32_t> fold_of_;
    std::vector<double> squared_error_;  ///< NaN: unknown
    std::vector<double> distance_;
    std::vector<std::uint32_t> order_;  ///< sites with an error by distance
    std::vector<std::uint32_t> near_;   ///< the nearest visible sites of each
    std::vector<std::size_t> near_begin_;
    Rates all_;
    double largest_ = 0;  ///< variance
};

}  // namespace terratet
