// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One property's estimates of samples that were left out: how far off they were, what would have been said of them
/// without having seen their own errors, and the calibration that makes the two agree.

#include <optional>
#include <span>
#include <vector>

#include "interp/calibration.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/plan/local_error.hpp"
#include "tess/barrier_query.hpp"

namespace terratet {

/// Boreholes (blocks of loose samples are as one each) in groups: a group's errors are judged from the others'.
struct ErrorGroups {
    std::vector<std::uint32_t> of_site;
    std::vector<std::size_t> boreholes;  ///< in each group

    /// Of folds (folds.hpp) that `all` boreholes share in turn, every `most`-th fold in the same group.
    ErrorGroups(std::size_t sites, std::span<const std::vector<std::uint32_t>> folds, std::size_t most,
                std::size_t all);
};

class ErrorStudy {
  public:
    /// All must outlive the calls below. \param values  in the property's scale, all finite
    /// \param own_variance  do weights come with the method's own?
    ErrorStudy(std::span<const Vec3> sites, std::span<const double> values, const ErrorGroups& groups,
               bool own_variance);

    /// Notes a site's estimate by others; without terms nothing.
    void add(std::uint32_t site, double estimate, const Weights& left_out);

    /// After the last add(): what is said of each estimate, learnt from the other groups' errors.
    /// \param left_out  of each site as add() had it; without terms it is not judged. Not read for an own variance.
    void judge(const BarrierQuery* barriers, std::span<const Weights> left_out);

    /// After the last add(), instead of judge(), when the calibration is known already.
    void learn(const BarrierQuery* barriers);

    /// From all that was judged.
    [[nodiscard]] Calibration calibration() const;

    /// What is stated of each site's estimate by the other groups: factors, too, have not seen the site's errors. NaN
    /// where nothing was judged.
    [[nodiscard]] std::vector<StatedError> stated() const;

    /// The methods' own figures where they have none of their own: judge() or learn() before.
    [[nodiscard]] std::optional<LocalError> take_local() { return std::move(local_); }

  private:
    [[nodiscard]] Calibration calibration(std::optional<std::uint32_t> without) const;

    std::span<const Vec3> sites_;
    std::span<const double> values_;
    const ErrorGroups& groups_;
    std::optional<LocalError> local_;
    std::vector<double> estimate_;
    std::vector<double> deviation_;
};

}  // namespace terratet
