// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/local_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "interp/query_order.hpp"
#include "interp/site_index.hpp"

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

double nearest_distance(std::span<const Vec3> sites, const Vec3& place, std::span<const SiteWeight> terms) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [site, weight] : terms) {
        nearest = std::min(nearest, squared_distance(place, sites[site]));
    }
    return std::sqrt(nearest);
}

}  // namespace

LocalError::LocalError(std::span<const Vec3> sites, std::span<const double> values)
    : sites_(sites), values_(values), rate_(sites.size(), unknown), largest_(2 * variance_of(values)) {}

void LocalError::add(std::uint32_t site, const Weights& left_out) {
    if (left_out.terms.empty()) {
        return;
    }
    double error = values_[site];
    for (const auto& [other, weight] : left_out.terms) {
        error -= weight * values_[other];
    }
    rate_[site] = error * error / nearest_distance(sites_, sites_[site], left_out.terms);
}

void LocalError::pool(const FaultProximity* faults, std::size_t count) {
    const std::vector<double> own = rate_;
    std::vector<ValueQuery> places(sites_.size());
    std::transform(sites_.begin(), sites_.end(), places.begin(), [](const Vec3& p) { return ValueQuery{p, -1, 0}; });
    const SiteIndex index(sites_, faults);
    in_spatial_order(places, [&](std::span<const std::uint32_t> run) {
        std::vector<NearSite> near;
        for (const std::uint32_t i : run) {
            index.nearest(places[i], count, near);
            double sum = 0;
            std::size_t known = 0;
            for (const auto& [squared_distance, site, slot] : near) {
                if (!std::isnan(own[site])) {
                    sum += own[site];
                    ++known;
                }
            }
            rate_[i] = known > 0 ? sum / static_cast<double>(known) : unknown;
        }
    });
}

double LocalError::standard_deviation(const Vec3& place, std::span<const SiteWeight> terms) const {
    double sum = 0;
    double weights = 0;
    for (const auto& [site, weight] : terms) {
        if (!std::isnan(rate_[site])) {
            sum += std::abs(weight) * rate_[site];
            weights += std::abs(weight);
        }
    }
    if (weights == 0) {
        return unknown;
    }
    return std::sqrt(std::min(nearest_distance(sites_, place, terms) * sum / weights, largest_));
}

}  // namespace terratet
