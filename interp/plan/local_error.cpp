// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/local_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interp/estimator/query_order.hpp"
#include "interp/sites/site_index.hpp"

namespace terratet {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double variance_of(std::span<const double> values) {
    double mean = 0;
    double sum = 0;
    std::size_t n = 0;
    for (const double value : values) {  // Welford's recurrence
        const double delta = value - mean;
        mean += delta / static_cast<double>(++n);
        sum += delta * (value - mean);
    }
    return n > 0 ? sum / static_cast<double>(n) : 0;
}

/// To the nearest site that is used; what is hidden counts as if it were the lever farther away.
double distance_to_used(std::span<const Vec3> sites, const Vec3& place, const Weights& weights) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [site, weight] : weights.terms) {
        nearest = std::min(nearest, squared_distance(place, sites[site]));
    }
    return std::sqrt(nearest) + weights.hidden * length(weights.lever);
}

constexpr std::uint32_t no_fold = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t classes_max = 10;
constexpr std::size_t errors_a_class = 20;

struct Step {
    double distance;
    double mean;
    double count;
};

/// The nearest rising sequence of means (pool adjacent violators).
void make_rise(std::vector<Step>& steps) {
    struct Block {
        double mean;
        double count;
        std::size_t steps;
    };
    std::vector<Block> blocks;
    for (const Step& step : steps) {
        blocks.push_back({step.mean, step.count, 1});
        while (blocks.size() > 1 && blocks[blocks.size() - 2].mean > blocks.back().mean) {
            const Block last = blocks.back();
            blocks.pop_back();
            Block& into = blocks.back();
            into.mean = (into.mean * into.count + last.mean * last.count) / (into.count + last.count);
            into.count += last.count;
            into.steps += last.steps;
        }
    }
    std::size_t at = 0;
    for (const Block& block : blocks) {
        for (std::size_t i = 0; i < block.steps; ++i) {
            steps[at++].mean = block.mean;
        }
    }
}

/// v(d); beyond the last class on along the line from the origin.
double profile(const LocalError::Rates& rates, double d) {
    const auto& x = rates.distance;
    const auto& y = rates.variance;
    const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), d) - x.begin());
    if (above == 0 || above == x.size()) {
        const std::size_t end = above == 0 ? 0 : x.size() - 1;
        return y[end] * d / x[end];
    }
    const double t = (d - x[above - 1]) / (x[above] - x[above - 1]);
    return y[above - 1] + t * (y[above] - y[above - 1]);
}

}  // namespace

LocalError::LocalError(std::span<const Vec3> sites, std::span<const double> values, std::vector<std::uint32_t> fold_of)
    : sites_(sites),
      fold_of_(std::move(fold_of)),
      squared_error_(sites.size(), unknown),
      distance_(sites.size(), unknown),
      largest_(2 * variance_of(values)) {}

void LocalError::add(std::uint32_t site, double error, const Weights& left_out) {
    if (left_out.terms.empty()) {
        return;
    }
    squared_error_[site] = error * error;
    distance_[site] = distance_to_used(sites_, sites_[site], left_out);
}

void LocalError::pool(const BarrierQuery* barriers, std::size_t count) {
    for (std::uint32_t i = 0; i < sites_.size(); ++i) {
        if (!std::isnan(squared_error_[i])) {
            order_.push_back(i);
        }
    }
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return distance_[a] < distance_[b]; });
    std::vector<ValueQuery> places(sites_.size());
    std::transform(sites_.begin(), sites_.end(), places.begin(), [](const Vec3& p) { return ValueQuery{p, -1, 0}; });
    std::vector<std::uint32_t> judged(order_);
    std::sort(judged.begin(), judged.end());
    std::vector<Vec3> judged_sites(judged.size());
    std::transform(judged.begin(), judged.end(), judged_sites.begin(), [&](std::uint32_t i) { return sites_[i]; });
    std::vector<std::uint32_t> found(sites_.size(), 0);
    near_.resize(sites_.size() * count);
    if (judged.empty()) {
        places.clear();
        judged_sites = {{}};  // an index has one
    }
    const SiteIndex index(judged_sites, barriers);
    in_spatial_order(places, [&](std::span<const std::uint32_t> run) {
        std::vector<NearSite> near;
        for (const std::uint32_t i : run) {
            index.nearest(places[i], count, near);
            for (const auto& [squared_distance, site, slot] : near) {
                near_[i * count + found[i]++] = judged[site];
            }
        }
    });
    near_begin_.assign(sites_.size() + 1, 0);
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        near_begin_[i + 1] = near_begin_[i] + found[i];
        std::copy_n(near_.begin() + static_cast<std::ptrdiff_t>(i * count), found[i],
                    near_.begin() + static_cast<std::ptrdiff_t>(near_begin_[i]));
    }
    near_.resize(near_begin_.back());
    all_ = rates(no_fold);
}

LocalError::Rates LocalError::without(std::uint32_t fold) const {
    return rates(fold);
}

void LocalError::forget() {
    near_ = {};
    near_begin_ = {};
    order_ = {};
}

LocalError::Rates LocalError::rates(std::uint32_t without) const {
    std::vector<std::uint32_t> seen;
    std::copy_if(order_.begin(), order_.end(), std::back_inserter(seen),
                 [&](std::uint32_t i) { return fold_of_[i] != without; });
    Rates out;
    out.near.assign(sites_.size(), unknown);
    const std::size_t classes = std::clamp<std::size_t>(seen.size() / errors_a_class, 1, classes_max);
    std::vector<Step> steps;
    for (std::size_t k = 0; k < classes && !seen.empty(); ++k) {
        const std::size_t begin = k * seen.size() / classes;
        const std::size_t end = (k + 1) * seen.size() / classes;
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i) {
            sum += squared_error_[seen[i]];
        }
        const auto count = static_cast<double>(end - begin);
        const double middle = distance_[seen[(begin + end) / 2]];
        if (!steps.empty() && middle <= steps.back().distance) {  // equal distances, as of regular holes
            Step& into = steps.back();
            into.mean = (into.mean * into.count + sum) / (into.count + count);
            into.count += count;
        } else if (middle > 0) {
            steps.push_back({middle, sum / count, count});
        }
    }
    if (steps.empty()) {
        return out;
    }
    make_rise(steps);
    for (const Step& step : steps) {
        out.distance.push_back(step.distance);
        out.variance.push_back(step.mean);
    }
    // Errors nearer than the first class would make rates of almost nothing over nothing.
    const auto expected = [&](std::uint32_t i) { return profile(out, std::max(distance_[i], out.distance.front())); };
    double squares = 0;
    double wanted = 0;
    std::vector<double> rate(sites_.size(), 0);
    for (const std::uint32_t i : seen) {
        const double usual = expected(i);
        squares += squared_error_[i];
        wanted += usual;
        rate[i] = usual > 0 ? squared_error_[i] / usual : 0;
    }
    const double common = wanted > 0 ? squares / wanted : 0;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        double sum = 0;
        std::size_t known = 0;
        for (std::size_t k = near_begin_[i]; k < near_begin_[i + 1]; ++k) {
            if (const std::uint32_t site = near_[k]; fold_of_[site] != without) {
                sum += rate[site];
                ++known;
            }
        }
        out.near[i] = known > 0 ? 0.5 * (common + sum / static_cast<double>(known)) : common;
    }
    return out;
}

double LocalError::standard_deviation(const Vec3& place, const Weights& weights, const Rates& rates) const {
    double sum = 0;
    double total = 0;
    for (const auto& [site, weight] : weights.terms) {
        if (!std::isnan(rates.near[site])) {
            sum += std::abs(weight) * rates.near[site];
            total += std::abs(weight);
        }
    }
    if (total == 0) {
        return unknown;
    }
    const double away = distance_to_used(sites_, place, weights);
    return std::sqrt(std::min(profile(rates, away) * sum / total, largest_));
}

}  // namespace terratet
