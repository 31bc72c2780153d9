// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How samples are left out to see how well the rest estimates them. A borehole is left out whole: its own samples, a
/// few metres away, would make every method look good (Roberts et al. 2017, Ecography 40).

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "interp/estimator/estimator.hpp"
#include "interp/estimator_plan.hpp"
#include "interp/natural/linear_precision.hpp"
#include "tess/samples.hpp"

namespace terratet {

class Ranks;

/// The samples named by `which`, in groups that are left out together: each borehole, and the loose samples in
/// `loose_folds` blocks of neighbours (fewer where there are fewer samples). With `max_folds` > 0 groups share folds in
/// turn, so that there are no more than that. Indices into `which`, each in exactly one fold; no fold is empty. One
/// borehole alone makes one fold: nothing can estimate it.
std::vector<std::vector<std::uint32_t>> folds_of(const Samples& samples, std::span<const std::uint32_t> which,
                                                 std::size_t max_folds = 0, std::size_t loose_folds = 20);

/// The same of places, each with its borehole, −1 for a loose one; each borehole and block by itself.
std::vector<std::vector<std::uint32_t>> folds_of(std::span<const Vec3> places, std::span<const std::int32_t> boreholes,
                                                 std::size_t loose_folds = 20);

/// Folds put together in turn, so that there are no more than `most`.
std::vector<std::vector<std::uint32_t>> shared(std::vector<std::vector<std::uint32_t>> folds, std::size_t most);

/// Makes the estimator over some of the sites, named by their indices: all but a fold's.
using PartialEstimator =
    std::function<std::unique_ptr<Estimator>(std::span<const std::uint32_t> kept, std::uint32_t fold)>;

/// A property's values at all sites.
struct FoldColumn {
    std::span<const double> scaled;
    ColumnTraits traits;
};

/// About `wanted` of `count` sites, or all: spread over any rows of them, however long the rows are.
class SomeSites {
  public:
    SomeSites(std::size_t count, std::size_t wanted);
    [[nodiscard]] bool contains(std::uint32_t site) const;

  private:
    double share_;
};

/// Calls `visit` with each site of `targets`, its weights from the sites of all other folds and for each column what
/// slopes add to the weighted mean, one at a time, fold by fold; terms name sites as `sites` does. No terms: the others
/// give no value there. Costs one estimator per fold; folds run in parallel, `make` must stand that. With several ranks
/// (null: alone) each calls it with the same arguments; they share the folds, and every rank sees all results.
void for_each_left_out(
    std::span<const Vec3> sites, const std::vector<std::vector<std::uint32_t>>& folds, const PartialEstimator& make,
    std::span<const FoldColumn> columns,
    const std::function<void(std::uint32_t site, const Weights& weights, std::span<const MadeUp> added)>& visit,
    const SomeSites& targets = {0, 0}, const Ranks* ranks = nullptr);

}  // namespace terratet
