// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A standard deviation for methods that know none, from cross-validation.
///
/// Leaving out sample i with its borehole gives an error eᵢ at a place dᵢ away from the nearest sample that was used.
/// Where errors grow like a linear variogram, their variance is proportional to that distance, so eᵢ²/dᵢ is a local
/// rate, averaged over the 32 nearest visible samples. The variance of an estimate h away from the nearest sample it
/// uses is h times the weighted mean of its samples' rates, at most twice the variance of all values: two independent
/// ones differ by no more. On a sample it is 0.
///
/// It is a figure of experience, not of theory: `terratet validate` says how often the truth lies within it.

#include <span>
#include <vector>

#include "interp/estimator.hpp"

namespace terratet {

class LocalError {
  public:
    /// \param sites   of the estimator; must outlive this
    /// \param values  at the sites, in the property's scale, all finite; must outlive the calls to add()
    LocalError(std::span<const Vec3> sites, std::span<const double> values);

    /// Notes what the others say of a site (folds.hpp); without terms nothing.
    void add(std::uint32_t site, const Weights& left_out);

    /// Averages, after the last add().
    void pool(const FaultProximity* faults, std::size_t count = 32);

    /// Of an estimate with these weights; NaN without terms, or where no sample could be left out. O(terms).
    [[nodiscard]] double standard_deviation(const Vec3& place, std::span<const SiteWeight> terms) const;

  private:
    std::span<const Vec3> sites_;
    std::span<const double> values_;
    std::vector<double> rate_;  ///< variance per unit of distance around each site; NaN: unknown
    double largest_ = 0;        ///< variance
};

}  // namespace terratet
