// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "interp/folds.hpp"
#include "interp/local_error.hpp"

namespace terratet {
namespace {

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
    double sum = 0;
    for (const auto& [site, weight] : terms) {
        sum += weight * measured[site];
    }
    return sum;
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

CrossValidation cross_validate(const Model& model, const FaultProximity& faults, std::size_t property,
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
    out.estimator = fitted_estimator(spec, sites, out.measured, boreholes, kind.kind);
    const auto make = [&](std::span<const std::uint32_t> kept) {
        std::vector<Vec3> some;
        std::vector<std::int32_t> holes;
        for (const std::uint32_t i : kept) {
            some.push_back(sites[i]);
            holes.push_back(boreholes[i]);
        }
        return make_estimator(out.estimator, std::move(some), &faults, std::move(holes));
    };
    const auto folds = folds_of(model.samples, out.sample, options.max_folds, options.loose_folds);
    out.folds = folds.size();
    const bool has_variance = make(folds.front())->has_variance();
    LocalError local_error(sites, out.measured);
    std::vector<std::vector<SiteWeight>> terms(sites.size());
    out.estimated.resize(sites.size());
    out.deviation.assign(sites.size(), missing);
    for_each_left_out(sites, folds, make, [&](std::uint32_t i, const Weights& weights) {
        out.estimated[i] = estimate_from(weights.terms, out.measured, kind.kind);
        out.fallbacks += weights.fallback ? 1 : 0;
        if (has_variance) {
            out.deviation[i] = weights.terms.empty() ? missing : std::sqrt(weights.variance);
        } else {
            local_error.add(i, weights);
            terms[i] = weights.terms;
        }
    });
    if (kind.kind == Kind::categorical) {
        out.deviation.assign(sites.size(), missing);
    } else if (has_variance) {
        out.deviation_source = DeviationSource::kriging;
    } else {
        out.deviation_source = DeviationSource::cross_validated;
        local_error.pool(&faults);
        for (std::size_t i = 0; i < sites.size(); ++i) {
            out.deviation[i] = local_error.standard_deviation(sites[i], terms[i]);
        }
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
    }
    return s;
}

}  // namespace terratet
