// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/cross_validation.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "interp/estimator/beside_barriers.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/kriging/variogram_fit.hpp"
#include "interp/plan/error_study.hpp"
#include "interp/plan/extrapolation.hpp"
#include "interp/plan/fitted_estimator.hpp"
#include "interp/plan/folds.hpp"
#include "interp/plan/learned_errors.hpp"
#include "interp/plan/make_estimator.hpp"

namespace terratet {
namespace {

/// Boreholes judged together: variograms and errors of one are learnt from the other groups'.
constexpr std::size_t groups_max = 20;

/// Some of the sites.
struct Some {
    std::vector<Vec3> sites;
    std::vector<double> values;
    std::vector<std::int32_t> boreholes;
};

double estimate_from(const std::vector<SiteWeight>& terms, const std::vector<double>& measured, Kind kind) {
    if (terms.empty()) {
        return missing;
    }
    if (kind == Kind::categorical) {
        std::map<double, double> weight_of;
        for (const auto& [site, weight] : terms) {
            weight_of[measured[site]] += weight;
        }
        return std::ranges::max_element(weight_of, {}, [](const auto& entry) { return entry.second; })->first;
    }
    return weighted_mean(terms, measured);
}

/// Ranks from 1, equal values sharing the mean of theirs.
std::vector<double> ranks(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<double> out(values.size());
    for (std::size_t begin = 0; begin < order.size();) {
        std::size_t end = begin;
        while (end < order.size() && values[order[end]] == values[order[begin]]) {
            ++end;
        }
        for (std::size_t i = begin; i < end; ++i) {
            out[order[i]] = 0.5 * static_cast<double>(begin + 1 + end);
        }
        begin = end;
    }
    return out;
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
    const auto n = static_cast<double>(a.size());
    const double mean_a = std::accumulate(a.begin(), a.end(), 0.0) / n;
    const double mean_b = std::accumulate(b.begin(), b.end(), 0.0) / n;
    double aa = 0;
    double bb = 0;
    double ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        aa += (a[i] - mean_a) * (a[i] - mean_a);
        bb += (b[i] - mean_b) * (b[i] - mean_b);
        ab += (a[i] - mean_a) * (b[i] - mean_b);
    }
    return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : missing;
}

}  // namespace

CrossValidation cross_validate(const Model& model, const BarrierQuery& barriers, std::size_t property,
                               const EstimatorSpec& spec, const CrossValidationOptions& options) {
    const Property& kind = model.properties[property];
    CrossValidation out;
    out.property = property;
    out.asked = spec;
    std::vector<Vec3> sites;
    std::vector<std::int32_t> boreholes;
    for (std::uint32_t s = 0; s < model.samples.size(); ++s) {
        const double scaled = to_scale(kind, model.samples.values[property][s]);
        if (!std::isnan(scaled)) {
            out.sample.push_back(s);
            out.measured.push_back(scaled);
            sites.push_back(model.samples.positions[s]);
            boreholes.push_back(model.samples.borehole[s]);
        }
    }
    sites = beside_barriers(std::move(sites), barriers);
    const BarrierQuery& seen = barriers.seen_by(property);
    out.estimator = fitted_estimator(spec, sites, out.measured, boreholes, kind.kind, &seen);
    const auto folds = folds_of(model.samples, out.sample, options.max_folds, options.loose_folds);
    const ErrorGroups groups(sites.size(), folds, groups_max,
                             folds_of(model.samples, out.sample, 0, options.loose_folds).size());
    const EstimatorSpec open = open_again(out.estimator, spec, sites, out.measured, boreholes, kind.kind);
    const auto some = [&](std::span<const std::uint32_t> kept) {
        Some part;
        for (const std::uint32_t i : kept) {
            part.sites.push_back(sites[i]);
            part.values.push_back(out.measured[i]);
            part.boreholes.push_back(boreholes[i]);
        }
        return part;
    };
    std::vector<EstimatorSpec> of_group(groups.boreholes.size(), out.estimator);
    if (needs_values(open) && of_group.size() > 1) {
        tbb::parallel_for(std::size_t{0}, of_group.size(), [&](std::size_t group) {
            std::vector<std::uint32_t> kept;
            for (std::uint32_t i = 0; i < sites.size(); ++i) {
                if (groups.of_site[i] != group) {
                    kept.push_back(i);
                }
            }
            const Some part = some(kept);
            of_group[group] =
                fitted_estimator(open, part.sites, part.values, part.boreholes, kind.kind, &seen, samples_of_fold_fit);
        });
    }
    const PartialEstimator make = [&](std::span<const std::uint32_t> kept, std::uint32_t fold) {
        Some part = some(kept);
        return make_estimator(of_group[fold % of_group.size()], std::move(part.sites), &seen,
                              std::move(part.boreholes));
    };
    out.folds = folds.size();
    const bool has_variance = make(folds.front(), 0)->has_variance();
    ErrorStudy study(sites, out.measured, groups, has_variance);
    std::vector<Weights> left_out(has_variance ? 0 : sites.size());
    std::vector<double> slope_variance(sites.size(), 0);
    std::vector<FoldColumn> columns;
    if (kind.kind == Kind::continuous) {
        columns.push_back({out.measured, traits_of(out.measured, reach_of(out.estimator, sites, boreholes))});
    }
    out.estimated.resize(sites.size());
    out.deviation.assign(sites.size(), missing);
    out.half_width.assign(sites.size(), missing);
    for_each_left_out(
        sites, folds, make, columns,
        [&](std::uint32_t i, const Weights& weights, const auto& added) {
            const MadeUp slopes = added.empty() ? MadeUp{} : added.front();
            out.estimated[i] = estimate_from(weights.terms, out.measured, kind.kind) + slopes.value;
            out.fallbacks += weights.fallback ? 1 : 0;
            study.add(i, out.estimated[i], weights);
            slope_variance[i] = slopes.variance;
            if (!has_variance) {
                left_out[i] = weights;
            }
        },
        {0, 0}, options.ranks);
    if (kind.kind == Kind::categorical) {
        return out;
    }
    out.deviation_source = has_variance ? DeviationSource::kriging : DeviationSource::cross_validated;
    study.judge(&seen, left_out);
    out.calibration = study.calibration();
    const auto stated = study.stated();
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const auto [deviation, half_width] = widened(stated[i], slope_variance[i]);
        out.deviation[i] = deviation;
        out.half_width[i] = half_width;
    }
    return out;
}

CrossValidationScore score(const CrossValidation& v, const Property& property) {
    CrossValidationScore s;
    std::vector<double> measured;
    std::vector<double> estimated;
    double squares = 0;
    double magnitudes = 0;
    double errors = 0;
    std::size_t right = 0;
    std::size_t stated = 0;
    std::size_t one = 0;
    std::size_t two = 0;
    std::size_t in_half_width = 0;
    for (std::size_t i = 0; i < v.measured.size(); ++i) {
        if (std::isnan(v.estimated[i])) {
            ++s.without_value;
            continue;
        }
        const double error = v.estimated[i] - v.measured[i];
        measured.push_back(v.measured[i]);
        estimated.push_back(v.estimated[i]);
        squares += error * error;
        magnitudes += std::abs(error);
        errors += error;
        right += error == 0 ? 1 : 0;
        if (!std::isnan(v.deviation[i])) {
            ++stated;
            one += std::abs(error) <= v.deviation[i] ? 1 : 0;
            two += std::abs(error) <= 1.96 * v.deviation[i] ? 1 : 0;
            in_half_width += std::abs(error) <= v.half_width[i] ? 1 : 0;
        }
    }
    s.count = measured.size();
    if (s.count == 0) {
        return s;
    }
    const auto n = static_cast<double>(s.count);
    if (property.kind == Kind::categorical) {
        s.accuracy = static_cast<double>(right) / n;
        return s;
    }
    s.rmse = std::sqrt(squares / n);
    s.mae = magnitudes / n;
    s.bias = errors / n;
    s.rank_correlation = correlation(ranks(measured), ranks(estimated));
    if (stated > 0) {
        s.within_one = static_cast<double>(one) / static_cast<double>(stated);
        s.within_two = static_cast<double>(two) / static_cast<double>(stated);
        s.within_half_width = static_cast<double>(in_half_width) / static_cast<double>(stated);
    }
    return s;
}

}  // namespace terratet
