// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/kriging/variogram_fit.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace terratet {
namespace {

/// Fewer pairs than that say nothing.
constexpr std::uint64_t pairs_min = 30;
constexpr std::size_t lags_min = 4;
constexpr double lags_max = 30;
constexpr double ratio_min = 0.01;
constexpr double ratio_max = 100;

/// Σ over the lags that the best nugget and sill for one range need.
struct Normal {
    double w = 0, wr = 0, wrr = 0, wg = 0, wrg = 0, wgg = 0;

    Normal(std::span<const Lag> lags, const Variogram& shape) {
        for (const Lag& lag : lags) {
            const double weight = static_cast<double>(lag.pairs) / (lag.distance * lag.distance);
            const double rise = 1 - shape.correlation(lag.distance);
            w += weight;
            wr += weight * rise;
            wrr += weight * rise * rise;
            wg += weight * lag.semivariance;
            wrg += weight * rise * lag.semivariance;
            wgg += weight * lag.semivariance * lag.semivariance;
        }
    }

    [[nodiscard]] double misfit(double nugget, double sill) const {
        return wgg - 2 * (nugget * wg + sill * wrg) + nugget * nugget * w + 2 * nugget * sill * wr + sill * sill * wrr;
    }
};

struct Candidate {
    double nugget = 0;
    double sill = 0;
    double misfit = std::numeric_limits<double>::infinity();
};

/// Non-negative least squares in two unknowns: the inner solution, or the better of the edges.
Candidate best_levels(const Normal& n, std::optional<double> nugget, std::optional<double> sill) {
    const auto sill_for = [&](double c) { return n.wrr > 0 ? std::max((n.wrg - c * n.wr) / n.wrr, 0.0) : 0; };
    const auto nugget_for = [&](double c) { return std::max((n.wg - c * n.wr) / n.w, 0.0); };
    std::vector<Candidate> tries;
    if (nugget || sill) {
        const double level = nugget ? *nugget : nugget_for(*sill);
        tries.push_back({level, sill ? *sill : sill_for(level)});
    } else {
        const double determinant = n.w * n.wrr - n.wr * n.wr;
        if (determinant > 1e-12 * n.w * n.wrr) {
            const double c = (n.wg * n.wrr - n.wr * n.wrg) / determinant;
            const double s = (n.w * n.wrg - n.wr * n.wg) / determinant;
            if (c >= 0 && s >= 0) {
                tries.push_back({c, s});
            }
        }
        tries.push_back({0, sill_for(0)});
        tries.push_back({nugget_for(0), 0});
    }
    for (Candidate& candidate : tries) {
        candidate.misfit = n.misfit(candidate.nugget, candidate.sill);
    }
    return *std::min_element(tries.begin(), tries.end(),
                             [](const auto& a, const auto& b) { return a.misfit < b.misfit; });
}

/// Lags that a fit may rest on.
std::vector<Lag> reliable(const std::vector<Lag>& lags) {
    std::vector<Lag> kept;
    std::copy_if(lags.begin(), lags.end(), std::back_inserter(kept),
                 [](const Lag& lag) { return lag.pairs >= pairs_min; });
    return kept.size() >= lags_min ? kept : std::vector<Lag>();
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

using Holes = std::map<std::int32_t, std::vector<std::uint32_t>>;

Holes holes_of(std::span<const std::int32_t> boreholes) {
    Holes holes;
    for (std::uint32_t i = 0; i < boreholes.size(); ++i) {
        if (boreholes[i] >= 0) {
            holes[boreholes[i]].push_back(i);
        }
    }
    return holes;
}

/// Half the length of the middle hole, where lags along holes end; 0 without holes of two samples.
double reach_along(const Holes& holes, std::span<const Vec3> places) {
    std::vector<double> lengths;
    for (const auto& [hole, samples] : holes) {
        if (samples.size() > 1) {
            lengths.push_back(distance(places[samples.front()], places[samples.back()]));
        }
    }
    return lengths.empty() ? 0 : 0.5 * median(lengths);
}

/// The usual distance from one sample to the next: shorter lags would be empty.
double spacing_along(const Holes& holes, std::span<const Vec3> places) {
    std::vector<double> spacings;
    for (const auto& [hole, samples] : holes) {
        for (std::size_t i = 1; i < samples.size(); ++i) {
            spacings.push_back(distance(places[samples[i - 1]], places[samples[i]]));
        }
    }
    return spacings.empty() ? 0 : median(spacings);
}

/// Are most holes nearer to the vertical than to the horizontal?
bool steep(const Holes& holes, std::span<const Vec3> places) {
    double down = 0;
    double length_sum = 0;
    for (const auto& [hole, samples] : holes) {
        const Vec3 whole = places[samples.back()] - places[samples.front()];
        down += std::abs(whole.z);
        length_sum += length(whole);
    }
    return down > std::sqrt(0.5) * length_sum;
}

Variogram flat_model(const VariogramRequest& request, double reach) {
    Variogram v{request.family,
                request.nu,
                request.nugget.value_or(0),
                request.sill.value_or(0),
                request.range.value_or(reach > 0 ? reach : 1),
                request.anisotropy};
    v.anisotropy.ratio3 = request.ratio3.value_or(1);
    return v;
}

}  // namespace

Variogram fit_model(std::span<const Lag> lags, Variogram start, std::optional<double> nugget,
                    std::optional<double> sill, std::optional<double> range) {
    assert(!lags.empty());
    Candidate best;
    double best_range = range.value_or(lags.back().distance);
    const auto attempt = [&](double candidate_range) {
        start.range = candidate_range;
        const Candidate candidate = best_levels(Normal(lags, start), nugget, sill);
        if (candidate.misfit < best.misfit) {
            best = candidate;
            best_range = candidate_range;
        }
    };
    if (range) {
        attempt(*range);
    } else {
        // The misfit may have several minima: a grid first, then ever finer around its best.
        double lo = 0.3 * lags.front().distance;
        double hi = 3 * lags.back().distance;
        for (int pass = 0; pass < 6; ++pass) {
            constexpr int steps = 40;
            const double factor = std::pow(hi / lo, 1.0 / steps);
            for (int i = 0; i <= steps; ++i) {
                attempt(lo * std::pow(factor, i));
            }
            lo = best_range / factor;
            hi = best_range * factor;
        }
    }
    start.range = best_range;
    start.nugget = best.nugget;
    start.sill = best.sill;
    return start;
}

VariogramFit fit_variogram(std::span<const Vec3> places, std::span<const double> values,
                           std::span<const std::int32_t> boreholes, const VariogramRequest& request) {
    const Box3 box = bounding_box(places);
    const Vec3 size = box.size();
    const double wide = std::hypot(size.x, size.y);
    const Holes holes = holes_of(boreholes);
    VariogramFit fit;
    fit.variogram = flat_model(request, 0.25 * box.diagonal());

    VariogramOptions options;
    options.robust = request.robust && !request.categorical;
    options.categorical = request.categorical;
    options.most_samples = request.most_samples;
    const auto lags = [&](PairKind kind, bool horizontal, double reach, double least_width) {
        options.pairs = kind;
        options.horizontal = horizontal;
        options.width = std::max(reach / lags_max, least_width);
        options.lags = static_cast<std::size_t>(std::ceil(reach / std::max(options.width, 1e-300)));
        return reach > 0 ? experimental_variogram(places, values, boreholes, options) : std::vector<Lag>();
    };
    fit.across = lags(PairKind::other_borehole, true, 0.4 * wide, 0);
    const std::size_t most = options.most_samples;
    options.most_samples = 1000;  // of one hole
    fit.along = lags(PairKind::same_borehole, false, reach_along(holes, places), spacing_along(holes, places));
    options.most_samples = most;

    const bool free_ratio = !request.ratio3 && request.anisotropy.ratio2 == 1 && request.anisotropy.azimuth_deg == 0 &&
                            request.anisotropy.dip_deg == 0 && request.anisotropy.roll_deg == 0;
    const auto along = reliable(fit.along);
    const auto across = reliable(fit.across);
    // In the metric asked for, if any: what is left to fit is one range.
    std::vector<Vec3> in_metric(places.size());
    std::transform(places.begin(), places.end(), in_metric.begin(), Metric(fit.variogram.anisotropy));
    options.pairs = PairKind::all;
    options.horizontal = false;
    if (const double reach = 0.4 * bounding_box(in_metric).diagonal(); reach > 0) {
        options.width = reach / lags_max;
        options.lags = static_cast<std::size_t>(lags_max);
        fit.all = experimental_variogram(in_metric, values, boreholes, options);
    }
    const auto all = reliable(fit.all);
    if (!along.empty() && !across.empty() && free_ratio && steep(holes, places)) {
        const Variogram down = fit_model(along, fit.variogram, request.nugget, request.sill, {});
        Variogram model =
            fit_model(across, fit.variogram, request.nugget.value_or(down.nugget), request.sill, request.range);
        const Variogram vertical = fit_model(along, fit.variogram, model.nugget, model.sill, {});
        if (!request.range && model.practical_range() < across.front().distance) {
            // No pair across is that near, so none tells how far it reaches.
            model.range = vertical.range;
        }
        model.anisotropy.ratio3 = std::clamp(vertical.range / model.range, ratio_min, ratio_max);
        fit.variogram = model;
        fit.apart = true;
        return fit;
    }
    if (const auto& lags_left = !all.empty() ? all : !along.empty() ? along : fit.all; !lags_left.empty()) {
        fit.variogram = fit_model(lags_left, fit.variogram, request.nugget, request.sill, request.range);
    }
    return fit;
}

}  // namespace terratet
