// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// `anisotropy=auto` and the estimator `auto`: chosen by leaving boreholes out.
///
/// Five folds of boreholes (blocks of loose samples), at most 2000 samples estimated; of more than 20 000 samples those
/// of the boreholes nearest the middle. Candidates are planes: the level one, those along which neighbouring boreholes
/// resemble each other most, the one that slopes of near samples tell (likely_planes.hpp), and what is best on a coarse
/// half sphere; each with ratios from 0.5 to 0.02, and the slopes' own ratios. All are tried with inverse distance:
/// where none gains a hundredth no tessellation is made, and the choice's rms stays 0. The three best that beat the
/// isotropic one there are tried with the estimator itself, and the best of them is taken if its errors are at least 3
/// % smaller than the isotropic one's (rms), smaller in more than two thirds of the folds, and the mean gain of a
/// borehole is three times its standard deviation (of fewer than eight boreholes: smaller in all folds). So a
/// tessellation is made 20 times at most. Counts decide, never the clock; the order of samples is of no effect.
///
/// `auto` compares natural, natural:smooth, kriging and idw likewise: another than natural is taken only if it wins by
/// as much.

#include <optional>
#include <string>
#include <vector>

#include "interp/estimator_plan.hpp"
#include "interp/plan/left_out_scores.hpp"

namespace terratet {

/// Does it say nothing about anisotropy, not even none?
bool leaves_anisotropy_open(const EstimatorSpec& spec);

/// Is it to be chosen: auto itself, or with anisotropy=auto?
bool is_to_be_chosen(const EstimatorSpec& spec);

/// With anisotropy=auto where it is left open.
EstimatorSpec with_open_chosen(EstimatorSpec spec);

/// The same for all of a plan's; but a plan that knows samples is a model's and stays as it was chosen.
EstimatorPlan with_open_chosen(EstimatorPlan plan);

/// As it is where nothing is chosen: natural for auto, without anisotropy=auto.
EstimatorSpec without_choice(EstimatorSpec spec);

struct EstimatorTrial {
    EstimatorSpec spec;
    double quick = 0;              ///< rms of inverse distance with its anisotropy
    std::optional<double> rms{};   ///< of itself; none: not tried
    std::size_t better_folds = 0;  ///< than the one it is compared with
};

struct ChosenEstimator {
    EstimatorSpec spec;  ///< nothing left to be chosen; a variogram may be left to be fitted
    EstimatorChoice choice{};
    std::vector<EstimatorTrial> trials{};  ///< those tried themselves, the one that others are compared with first
};

class EstimatorChooser {
  public:
    /// \param barriers  may be null; else must outlive this
    EstimatorChooser(const SampledValues& data, const BarrierQuery* barriers);

    /// \pre is_to_be_chosen(asked)
    [[nodiscard]] ChosenEstimator choose(const EstimatorSpec& asked);

  private:
    struct Candidate {
        Anisotropy anisotropy;
        double quick;
        bool isotropic;
    };
    const std::vector<Candidate>& candidates();
    [[nodiscard]] std::vector<Candidate> shortlist(std::size_t count);
    [[nodiscard]] bool can_tell() const;
    [[nodiscard]] EstimatorTrial trial(const EstimatorSpec& spec, double quick, const LeftOutScore* base,
                                       LeftOutScore& score) const;
    [[nodiscard]] EstimatorSpec with_drift(EstimatorSpec spec) const;
    void try_anisotropies(const EstimatorSpec& method, std::size_t count, const LeftOutScore& base,
                          ChosenEstimator& out, std::vector<LeftOutScore>& scores);
    static void decide(const std::vector<LeftOutScore>& scores, ChosenEstimator& out);

    LeftOutScores scores_;
    const BarrierQuery* barriers_;
    std::vector<Candidate> candidates_;  ///< the isotropic first; empty: not looked for yet
};

}  // namespace terratet
