// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How well a way of estimating does at samples that are left out with their borehole, by the same few folds for all
/// ways, so that they can be compared.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "interp/estimator_spec.hpp"
#include "interp/plan/folds.hpp"
#include "tess/barrier_query.hpp"
#include "tess/property.hpp"

namespace terratet {

/// Of one property.
struct SampledValues {
    std::vector<Vec3> sites;
    std::vector<double> values;             ///< in the scale, finite; of a category the class
    std::vector<std::int32_t> boreholes{};  ///< −1: loose
    Kind kind = Kind::continuous;
};

/// In the order of their coordinates, boreholes numbered as they come, hence the same in any order of rows. Of more
/// than `most` samples those of the boreholes (blocks of loose ones) nearest the middle of all.
SampledValues canonical_part(const SampledValues& all, std::size_t most);

/// Errors by borehole (block of loose samples). A category's are 1 where the class is wrong.
struct LeftOutScore {
    std::size_t folds;  ///< borehole b is in fold b mod folds
    std::vector<double> squares;
    std::vector<double> counts;

    [[nodiscard]] double rms() const;
    /// In how many folds its errors are smaller than the other's.
    [[nodiscard]] std::size_t better_folds(const LeftOutScore& other) const;
    /// Student's t of the boreholes' differences: how sure it is that its errors are smaller than the other's.
    [[nodiscard]] double surely_better(const LeftOutScore& other) const;
};

class LeftOutScores {
  public:
    /// \param barriers  may be null; else must outlive this
    LeftOutScores(SampledValues data, const BarrierQuery* barriers, std::size_t most_folds, std::size_t targets);

    [[nodiscard]] const SampledValues& data() const { return data_; }
    [[nodiscard]] std::size_t folds() const { return folds_.size(); }

    /// A quick one: inverse distance over 12 samples, at most 3 of a borehole, at some of the targets. One tree.
    /// What is in sight of each target is kept from call to call, a byte a target and sample.
    [[nodiscard]] LeftOutScore by_distance(const Anisotropy& anisotropy, std::size_t targets);

    /// The estimator itself, with what it leaves open fitted in each fold anew. An estimator a fold.
    /// \pre the drift of kriging is given
    [[nodiscard]] LeftOutScore of(const EstimatorSpec& spec) const;

  private:
    [[nodiscard]] LeftOutScore none() const;
    [[nodiscard]] std::vector<std::uint32_t> some(std::size_t targets) const;
    void note(std::uint32_t site, double estimate, LeftOutScore& score) const;

    SampledValues data_;
    const BarrierQuery* barriers_;
    std::vector<std::vector<std::uint32_t>> boreholes_;  ///< their sites, as scores number them; blocks of loose ones
    std::vector<std::vector<std::uint32_t>> folds_;
    std::vector<std::uint32_t> borehole_of_;  ///< of each site
    std::vector<std::size_t> others_give_;    ///< of each fold: near samples that by_distance can find outside it
    std::size_t targets_;
    enum Sight : std::uint8_t { unknown, open, hidden };
    std::vector<Sight> sight_;  ///< of each target, of each site; empty without barriers
    double usual_;              ///< in place of an estimate where there is none
};

}  // namespace terratet
