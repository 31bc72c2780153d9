// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/kriging/experimental_variogram.hpp"

#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

namespace terratet {
namespace {

using Indices = std::vector<std::uint32_t>;

/// Every k-th, so that no more than `most` remain.
Indices thinned(const Indices& all, std::size_t most) {
    const std::size_t step = (all.size() + most - 1) / std::max<std::size_t>(most, 1);
    Indices kept;
    for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(step, 1)) {
        kept.push_back(all[i]);
    }
    return kept;
}

/// Samples whose pairs are looked at, all with all.
std::vector<Indices> clusters(std::size_t count, std::span<const std::int32_t> boreholes,
                              const VariogramOptions& options) {
    if (options.pairs == PairKind::same_borehole) {
        std::map<std::int32_t, Indices> holes;
        for (std::uint32_t i = 0; i < boreholes.size(); ++i) {
            if (boreholes[i] >= 0) {
                holes[boreholes[i]].push_back(i);
            }
        }
        std::vector<Indices> out;
        for (const auto& [hole, samples] : holes) {
            out.push_back(thinned(samples, options.most_samples));
        }
        return out;
    }
    Indices all(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        all[i] = i;
    }
    return {thinned(all, options.most_samples)};
}

/// Sums of one lag.
struct Sums {
    double distance = 0;
    double difference = 0;
    std::uint64_t pairs = 0;
};

class PairFilter {
  public:
    PairFilter(std::span<const std::int32_t> boreholes, const VariogramOptions& options)
        : boreholes_(boreholes),
          across_(options.pairs == PairKind::other_borehole && !boreholes.empty()),
          horizontal_(options.horizontal),
          direction_(options.direction),
          directed_(options.direction != Vec3{}),
          cosine_(std::cos(options.tolerance_deg * std::numbers::pi / 180)),
          sine_(std::sin(options.tolerance_deg * std::numbers::pi / 180)) {}

    [[nodiscard]] bool operator()(std::uint32_t a, std::uint32_t b, const Vec3& between, double h) const {
        return !(across_ && boreholes_[a] == boreholes_[b] && boreholes_[a] >= 0) &&
               !(horizontal_ && std::abs(between.z) > sine_ * h) &&
               !(directed_ && std::abs(dot(between, direction_)) < cosine_ * h);
    }

  private:
    std::span<const std::int32_t> boreholes_;
    bool across_;
    bool horizontal_;
    Vec3 direction_;
    bool directed_;
    double cosine_;
    double sine_;
};

/// Twice what a pair adds to the mean, or its square root's root.
double difference(double a, double b, const VariogramOptions& options) {
    const double d = options.categorical ? (a == b ? 0 : std::numbers::sqrt2) : std::abs(a - b);
    return options.robust ? std::sqrt(d) : d * d;
}

double semivariance(const Sums& sums, bool robust) {
    const auto n = static_cast<double>(sums.pairs);
    const double mean = sums.difference / n;
    return robust ? 0.5 * mean * mean * mean * mean / (0.457 + 0.494 / n) : 0.5 * mean;
}

}  // namespace

std::vector<Lag> experimental_variogram(std::span<const Vec3> places, std::span<const double> values,
                                        std::span<const std::int32_t> boreholes, const VariogramOptions& options) {
    assert(places.size() == values.size() && options.width > 0);
    const PairFilter counts(boreholes, options);
    const double reach = options.width * static_cast<double>(options.lags);
    std::vector<Sums> sums(options.lags);
    for (const auto& cluster : clusters(places.size(), boreholes, options)) {
        for (std::size_t i = 0; i < cluster.size(); ++i) {
            for (std::size_t j = i + 1; j < cluster.size(); ++j) {
                const std::uint32_t a = cluster[i];
                const std::uint32_t b = cluster[j];
                const Vec3 between = places[b] - places[a];
                const double squared = squared_length(between);
                if (squared > reach * reach || squared == 0) {
                    continue;
                }
                const double h = std::sqrt(squared);
                if (!counts(a, b, between, h)) {
                    continue;
                }
                const auto lag = static_cast<std::size_t>(std::ceil(h / options.width)) - 1;
                Sums& into = sums[std::min(lag, sums.size() - 1)];
                into.distance += h;
                into.difference += difference(values[a], values[b], options);
                ++into.pairs;
            }
        }
    }
    std::vector<Lag> lags;
    for (const Sums& s : sums) {
        if (s.pairs > 0) {
            lags.push_back({s.distance / static_cast<double>(s.pairs), semivariance(s, options.robust), s.pairs});
        }
    }
    return lags;
}

}  // namespace terratet
