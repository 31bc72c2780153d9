// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Estimators: values at places from the original samples. Every method here is linear, so an estimator yields weights
/// over its sites and serves all properties measured at the same sites at once.
///
/// Faults are barriers: a sample counts only if the segment to it crosses no fault's sheet; weights are renormalised.
/// A place all of whose samples are hidden gets no value.

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tess/value_source.hpp"

namespace terratet {

struct SiteWeight {
    std::uint32_t site;
    double weight;
};

/// An estimate before values are put in. Weights sum to 1 within rounding, or there are none: no value here.
/// Lengths are in the coordinates of the method's anisotropy.
struct Weights {
    std::vector<SiteWeight> terms;
    double beyond = 0;  ///< what sites have no part in, 0…1: the ghosts' share, kriging's weight of the mean
    double hidden = 0;  ///< share that ghosts and sites behind faults had before the rest was scaled to sum to 1
    Vec3 lever{};       ///< from the terms' weighted centroid to the query, of a method that makes up for it by
                        ///< slopes (Estimator::slopes); 0 where nothing is hidden
    std::vector<SiteWeight> slope_terms;  ///< whose slopes count along the lever; empty: the terms
    double distance = std::numeric_limits<double>::infinity();  ///< the shortest way to a site (ways_round.hpp)
    bool wide = false;      ///< depends on more sites than those about the place: any change of sites may change it
    bool fallback = false;  ///< computed by a slower or simpler way than the method's own
    double variance = std::numeric_limits<double>::quiet_NaN();  ///< of the estimate's error in the scale's unit
                                                                 ///< squared; NaN where the method knows none

    /// As new, but for the lists' memory.
    void clear() {
        terms.clear();
        slope_terms.clear();
        *this = Weights{.terms = std::move(terms), .slope_terms = std::move(slope_terms)};
    }
};

class Slopes;

/// Where what is estimated may differ from what another estimator, over nearly the same sites, said.
class ChangedPlaces {
  public:
    virtual ~ChangedPlaces() = default;
    /// \param way  there was none longer than this to a site, as far as it mattered. Safe from any thread. Places whose
    ///             weights were `wide` are not told of.
    [[nodiscard]] virtual bool at(const Vec3& place, double way) const = 0;
};

/// Sites before and after an exchange of some, in an estimator's numbering.
struct ExchangedSites {
    std::vector<std::int64_t> before;  ///< of each site its number before; −1: it is new, or of another value
    std::vector<Vec3> places;          ///< of those that left and of those that came
};

class Estimator {
  public:
    virtual ~Estimator() = default;

    /// Weights at each query, out[i] for queries[i]. Const, reentrant, and each result independent of the others.
    virtual void weights(std::span<const ValueQuery> queries, std::span<Weights> out) const = 0;

    /// Of values at its sites, a span for each column, what lies along the lever: slopes.hpp. Null for a method whose
    /// weights have none. The estimator and the values must outlive it.
    [[nodiscard]] virtual std::shared_ptr<const Slopes> slopes(std::vector<std::span<const double>> columns) const;

    /// Where weights, or what slopes add to them, differ from an earlier estimator's of the same kind, options and
    /// barriers; slopes that are the same are carried over. Null: anywhere.
    /// \param slopes, slopes_before  of these sites and those; nothing was asked of the first one yet. All that was
    ///                                estimated before and is to be judged has been asked of `before`
    [[nodiscard]] virtual std::unique_ptr<const ChangedPlaces> changes_since(const Estimator& before,
                                                                             const ExchangedSites& sites,
                                                                             const Slopes* slopes_before,
                                                                             const Slopes* slopes) const;

    /// Do its weights come with a variance of their own?
    [[nodiscard]] virtual bool has_variance() const { return false; }
};

}  // namespace terratet
