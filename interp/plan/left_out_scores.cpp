// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/left_out_scores.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "interp/anisotropy.hpp"
#include "interp/kriging/fitted_variogram.hpp"
#include "interp/plan/extrapolation.hpp"
#include "interp/plan/make_estimator.hpp"
#include "interp/sites/site_tree.hpp"

namespace terratet {
namespace {

constexpr Neighbourhood near_by{.max_points = 12, .per_borehole = 3};
constexpr std::size_t looked_at_max = 500;  // besides those of the target's own borehole

SampledValues picked(const SampledValues& from, std::span<const std::uint32_t> which) {
    SampledValues out{{}, {}, {}, from.kind};
    for (const std::uint32_t i : which) {
        out.sites.push_back(from.sites[i]);
        out.values.push_back(from.values[i]);
        out.boreholes.push_back(from.boreholes[i]);
    }
    return out;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The boreholes nearest the middle.
SampledValues middle_part(const SampledValues& all, std::size_t most) {
    Vec3 middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> at;
        for (const Vec3& site : all.sites) {
            at.push_back(site[axis]);
        }
        middle[axis] = median(std::move(at));
    }
    const auto groups = folds_of(all.sites, all.boreholes);
    std::vector<std::pair<double, std::size_t>> by_distance;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        Vec3 sum;
        for (const std::uint32_t i : groups[g]) {
            sum = sum + all.sites[i];
        }
        by_distance.emplace_back(squared_distance(sum / static_cast<double>(groups[g].size()), middle), g);
    }
    std::sort(by_distance.begin(), by_distance.end());
    std::vector<std::uint32_t> kept;
    for (const auto& [distance, g] : by_distance) {
        if (!kept.empty() && kept.size() + groups[g].size() > most) {
            break;
        }
        kept.insert(kept.end(), groups[g].begin(), groups[g].end());
    }
    std::sort(kept.begin(), kept.end());
    return picked(all, kept);
}

/// \param value_of  of a term's site
template <typename ValueOf>
double estimate_of(std::span<const SiteWeight> terms, Kind kind, const ValueOf& value_of) {
    double sum = 0;
    std::map<double, double> weight_of;
    for (const auto& [site, weight] : terms) {
        sum += weight * value_of(site);
        if (kind == Kind::categorical) {
            weight_of[value_of(site)] += weight;
        }
    }
    return kind == Kind::continuous
               ? sum
               : std::ranges::max_element(weight_of, {}, [](const auto& entry) { return entry.second; })->first;
}

}  // namespace

SampledValues canonical_part(const SampledValues& all, std::size_t most) {
    std::vector<std::uint32_t> order(all.sites.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return all.sites[a] < all.sites[b]; });
    SampledValues out = picked(all, order);
    std::map<std::int32_t, std::int32_t> number;
    for (auto& borehole : out.boreholes) {
        if (borehole >= 0) {
            borehole = number.try_emplace(borehole, static_cast<std::int32_t>(number.size())).first->second;
        }
    }
    return out.sites.size() > most ? middle_part(out, most) : out;
}

double LeftOutScore::rms() const {
    return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) /
                     std::max(1.0, std::accumulate(counts.begin(), counts.end(), 0.0)));
}

std::size_t LeftOutScore::better_folds(const LeftOutScore& other) const {
    std::vector<double> gain(folds, 0);
    for (std::size_t b = 0; b < squares.size(); ++b) {
        gain[b % folds] += other.squares[b] - squares[b];
    }
    return static_cast<std::size_t>(std::ranges::count_if(gain, [](double g) { return g > 0; }));
}

double LeftOutScore::surely_better(const LeftOutScore& other) const {
    const auto n = static_cast<double>(squares.size());
    double sum = 0;
    double sum_of_squares = 0;
    for (std::size_t b = 0; b < squares.size(); ++b) {
        const double gain = other.squares[b] - squares[b];
        sum += gain;
        sum_of_squares += gain * gain;
    }
    const double variance = (sum_of_squares - sum * sum / n) / (n - 1);
    return variance > 0 ? sum / std::sqrt(n * variance) : 0;
}

LeftOutScores::LeftOutScores(SampledValues data, const BarrierQuery* barriers, std::size_t most_folds,
                             std::size_t targets)
    : data_(std::move(data)),
      barriers_(barriers != nullptr && !barriers->empty() ? barriers : nullptr),
      boreholes_(folds_of(data_.sites, data_.boreholes)),
      folds_(shared(boreholes_, most_folds)),
      borehole_of_(data_.sites.size()),
      targets_(targets),
      usual_(median(data_.values)) {
    others_give_.assign(folds_.size(), 0);
    for (std::uint32_t b = 0; b < boreholes_.size(); ++b) {
        for (const std::uint32_t i : boreholes_[b]) {
            borehole_of_[i] = b;
        }
        const bool is_loose = data_.boreholes[boreholes_[b].front()] < 0;
        for (std::size_t f = 0; f < folds_.size(); ++f) {
            others_give_[f] += f == b % folds_.size() ? 0
                               : is_loose             ? boreholes_[b].size()
                                                      : std::size_t{near_by.per_borehole};
        }
    }
}

LeftOutScore LeftOutScores::none() const {
    return {folds_.size(), std::vector<double>(boreholes_.size(), 0), std::vector<double>(boreholes_.size(), 0)};
}

void LeftOutScores::note(std::uint32_t site, double estimate, LeftOutScore& score) const {
    const double error = estimate - data_.values[site];
    const double counted = data_.kind == Kind::categorical && error != 0 ? 1 : error;
    score.squares[borehole_of_[site]] += counted * counted;
    score.counts[borehole_of_[site]] += 1;
}

std::vector<std::uint32_t> LeftOutScores::some(std::size_t targets) const {
    const SomeSites chosen(data_.sites.size(), targets);
    std::vector<std::uint32_t> out;
    for (std::uint32_t i = 0; i < data_.sites.size(); ++i) {
        if (chosen.contains(i)) {
            out.push_back(i);
        }
    }
    return out;
}

LeftOutScore LeftOutScores::by_distance(const Anisotropy& anisotropy, std::size_t targets) {
    const Metric metric(anisotropy);
    std::vector<Vec3> places(data_.sites.size());
    std::transform(data_.sites.begin(), data_.sites.end(), places.begin(), metric);
    const SiteTree tree(places, data_.boreholes);
    const auto asked = some(std::min(targets, targets_));  // fewer of them are a part of all
    const auto all = some(targets_);
    if (barriers_ != nullptr && sight_.empty()) {
        sight_.assign(all.size() * places.size(), unknown);
    }
    std::vector<double> estimates(asked.size(), usual_);
    tbb::parallel_for(std::size_t{0}, asked.size(), [&](std::size_t k) {
        const std::uint32_t i = asked[k];
        const auto row = static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), i) - all.begin());
        const auto in_sight = [&](std::uint32_t j) {
            Sight& known = sight_[row * places.size() + j];
            if (known == unknown) {
                known = barriers_->crosses_any(data_.sites[i], data_.sites[j]) ? hidden : open;
            }
            return known == open;
        };
        const auto usable = [&](std::uint32_t j) {
            return borehole_of_[j] % folds_.size() != borehole_of_[i] % folds_.size() &&
                   (barriers_ == nullptr || in_sight(j));
        };
        Neighbourhood limits = near_by;
        limits.max_points = std::min(limits.max_points, others_give_[borehole_of_[i] % folds_.size()]);
        limits.max_looked_at = looked_at_max + boreholes_[borehole_of_[i]].size();
        thread_local std::vector<NearSite> near;
        tree.neighbourhood(places[i], limits, usable, near);
        std::vector<SiteWeight> terms;
        double total = 0;
        for (const auto& [squared_distance, site, slot] : near) {
            terms.push_back({site, near.front().squared_distance / squared_distance});
            total += terms.back().weight;
        }
        for (auto& term : terms) {
            term.weight /= total;
        }
        if (!terms.empty()) {
            estimates[k] = estimate_of(terms, data_.kind, [&](std::uint32_t j) { return data_.values[j]; });
        }
    });
    LeftOutScore score = none();
    for (std::size_t k = 0; k < asked.size(); ++k) {
        note(asked[k], estimates[k], score);
    }
    return score;
}

LeftOutScore LeftOutScores::of(const EstimatorSpec& spec) const {
    const PartialEstimator make = [&](std::span<const std::uint32_t> kept, std::uint32_t) {
        SampledValues part = picked(data_, kept);
        const EstimatorSpec fitted =
            with_fitted_variogram(spec, part.sites, part.values, part.boreholes, data_.kind, samples_of_fold_fit);
        return make_estimator(fitted, std::move(part.sites), barriers_, std::move(part.boreholes));
    };
    std::vector<FoldColumn> columns;
    if (data_.kind == Kind::continuous) {
        // What slopes add fades beyond the reach, which no variogram is needed for.
        const EstimatorSpec spaced{"nearest", {}};
        const double reach = needs_values(spec) ? reach_of(spaced, data_.sites, data_.boreholes)
                                                : reach_of(spec, data_.sites, data_.boreholes);
        columns.push_back({data_.values, traits_of(data_.values, reach)});
    }
    LeftOutScore score = none();
    for_each_left_out(
        data_.sites, folds_, make, columns,
        [&](std::uint32_t site, const Weights& weights, std::span<const MadeUp> added) {
            const double estimate =
                weights.terms.empty()
                    ? usual_
                    : estimate_of(weights.terms, data_.kind, [&](std::uint32_t j) { return data_.values[j]; });
            note(site, estimate + (added.empty() ? 0 : added.front().value), score);
        },
        SomeSites(data_.sites.size(), targets_));
    return score;
}

}  // namespace terratet
