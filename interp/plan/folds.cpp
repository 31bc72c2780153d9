// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/folds.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

#include "interp/base/morton.hpp"
#include "interp/plan/extrapolation.hpp"
#include "interp/ranks/bytes.hpp"
#include "interp/ranks/ranks.hpp"

namespace terratet {
namespace {

using Fold = std::vector<std::uint32_t>;

/// Runs along the Morton curve: neighbours fall into the same block.
std::vector<Fold> blocks(std::span<const Vec3> all, const Fold& loose, std::size_t count) {
    std::vector<Vec3> places;
    for (const std::uint32_t i : loose) {
        places.push_back(all[i]);
    }
    const auto order = morton_order(places);
    count = std::min(count, loose.size());
    std::vector<Fold> folds(count);
    for (std::size_t k = 0; k < order.size(); ++k) {
        folds[k * count / order.size()].push_back(loose[order[k]]);
    }
    return folds;
}

/// What the kept sites' slopes add to estimates from them.
void add_slopes(const Estimator& estimator, std::span<const FoldColumn> columns, const Fold& kept,
                const std::vector<Weights>& weights, std::vector<MadeUp>& added) {
    std::vector<std::vector<double>> some(columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c) {
        for (const std::uint32_t i : kept) {
            some[c].push_back(columns[c].scaled[i]);
        }
    }
    const auto slopes = estimator.slopes({some.begin(), some.end()});
    for (std::size_t k = 0; k < weights.size(); ++k) {
        for (std::size_t c = 0; c < columns.size(); ++c) {
            const auto& traits = columns[c].traits;
            added[k * columns.size() + c] =
                made_up(weighted_mean(weights[k].terms, some[c]), weights[k],
                        extrapolation_at(weights[k].distance, traits.reach), slopes.get(), c, traits);
        }
    }
}

/// Of one fold.
struct Result {
    std::vector<std::uint32_t> sites;
    std::vector<Weights> weights;
    std::vector<MadeUp> added;  ///< of each query, by column
};

void put(const Result& result, ByteWriter& out) {
    out.put(result.sites);
    out.put(result.added);
    for (const Weights& w : result.weights) {
        out.put(w.terms);
        out.put(w.slope_terms);
        out.put(std::array{w.beyond, w.hidden, w.lever.x, w.lever.y, w.lever.z, w.distance, w.variance});
        out.put(w.fallback);
    }
}

Result get_result(ByteReader& in) {
    Result result;
    result.sites = in.list<std::uint32_t>();
    result.added = in.list<MadeUp>();
    result.weights.resize(result.sites.size());
    for (Weights& w : result.weights) {
        w.terms = in.list<SiteWeight>();
        w.slope_terms = in.list<SiteWeight>();
        const auto [beyond, hidden, x, y, z, distance, variance] = in.get<std::array<double, 7>>();
        w.beyond = beyond;
        w.hidden = hidden;
        w.lever = {x, y, z};
        w.distance = distance;
        w.variance = variance;
        w.fallback = in.get<bool>();
    }
    return result;
}

/// Each rank has made those whose number is its own, modulo how many there are.
void exchange_results(const Ranks& ranks, std::vector<Result>& results) {
    const auto count = static_cast<std::size_t>(ranks.count());
    ByteWriter own;
    for (auto k = static_cast<std::size_t>(ranks.rank()); k < results.size(); k += count) {
        put(results[k], own);
    }
    const std::vector<std::string> all = ranks.exchange(own.take());
    for (std::size_t rank = 0; rank < count; ++rank) {
        ByteReader in(all[rank]);
        for (std::size_t k = rank; k < results.size(); k += count) {
            results[k] = get_result(in);
        }
    }
}

}  // namespace

std::vector<Fold> folds_of(std::span<const Vec3> places, std::span<const std::int32_t> boreholes,
                           std::size_t loose_folds) {
    assert(loose_folds > 0);
    std::map<std::int32_t, Fold> holes;
    Fold loose;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        (boreholes[i] < 0 ? loose : holes[boreholes[i]]).push_back(i);
    }
    std::vector<Fold> folds;
    for (auto& [hole, fold] : holes) {
        folds.push_back(std::move(fold));
    }
    auto of_loose = blocks(places, loose, loose_folds);
    std::move(of_loose.begin(), of_loose.end(), std::back_inserter(folds));
    return folds;
}

std::vector<Fold> shared(std::vector<Fold> folds, std::size_t most) {
    for (std::size_t f = most; f < folds.size(); ++f) {
        auto& into = folds[f % most];
        into.insert(into.end(), folds[f].begin(), folds[f].end());
    }
    folds.resize(std::min(folds.size(), most));
    return folds;
}

std::vector<Fold> folds_of(const Samples& samples, std::span<const std::uint32_t> which, std::size_t max_folds,
                           std::size_t loose_folds) {
    std::vector<Vec3> places;
    std::vector<std::int32_t> boreholes;
    for (const std::uint32_t i : which) {
        places.push_back(samples.positions[i]);
        boreholes.push_back(samples.borehole[i]);
    }
    auto folds = folds_of(places, boreholes, loose_folds);
    return max_folds > 0 ? shared(std::move(folds), max_folds) : folds;
}

SomeSites::SomeSites(std::size_t count, std::size_t wanted)
    : share_(count <= wanted ? 1 : static_cast<double>(wanted) / static_cast<double>(count)) {}

bool SomeSites::contains(std::uint32_t site) const {
    double whole = 0;
    return share_ == 1 || std::modf(site * std::numbers::phi, &whole) < share_;
}

void for_each_left_out(
    std::span<const Vec3> sites, const std::vector<Fold>& folds, const PartialEstimator& make,
    std::span<const FoldColumn> columns,
    const std::function<void(std::uint32_t site, const Weights& weights, std::span<const MadeUp> added)>& visit,
    const SomeSites& targets, const Ranks* ranks) {
    std::vector<std::uint32_t> fold_of(sites.size());
    for (std::uint32_t f = 0; f < folds.size(); ++f) {
        for (const std::uint32_t i : folds[f]) {
            fold_of[i] = f;
        }
    }
    const auto leave_out = [&](std::uint32_t f) {
        std::vector<std::uint32_t> kept;
        for (std::uint32_t i = 0; i < sites.size(); ++i) {
            if (fold_of[i] != f) {
                kept.push_back(i);
            }
        }
        Result result;
        std::vector<ValueQuery> queries;
        for (const std::uint32_t i : folds[f]) {
            if (targets.contains(i)) {
                result.sites.push_back(i);
                queries.push_back({sites[i], -1, 0});
            }
        }
        result.weights.resize(queries.size());
        result.added.resize(queries.size() * columns.size());
        if (kept.empty() || queries.empty()) {
            return result;
        }
        const auto estimator = make(kept, f);
        estimator->weights(queries, result.weights);
        add_slopes(*estimator, columns, kept, result.weights, result.added);
        for (auto& weights : result.weights) {
            for (auto& term : weights.terms) {
                term.site = kept[term.site];
            }
        }
        return result;
    };
    // Some folds at a time, so that their weights do not pile up.
    const auto sharing = static_cast<std::uint32_t>(ranks == nullptr ? 1 : ranks->count());
    const auto rank = static_cast<std::uint32_t>(ranks == nullptr ? 0 : ranks->rank());
    const std::uint32_t at_a_time = 32 * sharing;
    const auto count = static_cast<std::uint32_t>(folds.size());
    for (std::uint32_t begin = 0; begin < count; begin += at_a_time) {
        std::vector<Result> results(std::min(at_a_time, count - begin));
        tbb::parallel_for(std::uint32_t{0}, static_cast<std::uint32_t>(results.size()), [&](std::uint32_t k) {
            if (k % sharing == rank) {
                results[k] = leave_out(begin + k);
            }
        });
        if (sharing > 1) {
            exchange_results(*ranks, results);
        }
        for (std::uint32_t k = 0; k < results.size(); ++k) {
            const auto& [sites_of, weights, added] = results[k];
            for (std::size_t i = 0; i < weights.size(); ++i) {
                visit(sites_of[i], weights[i], std::span(added).subspan(i * columns.size(), columns.size()));
            }
        }
    }
}

}  // namespace terratet
