// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/error_study.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tess/samples.hpp"

namespace terratet {

ErrorGroups::ErrorGroups(std::size_t sites, std::span<const std::vector<std::uint32_t>> folds, std::size_t most,
                         std::size_t all)
    : of_site(sites), boreholes(std::min(folds.size(), most), 0) {
    for (std::size_t f = 0; f < folds.size(); ++f) {
        const std::size_t group = f % boreholes.size();
        boreholes[group] += (all - f + folds.size() - 1) / folds.size();
        for (const std::uint32_t i : folds[f]) {
            of_site[i] = static_cast<std::uint32_t>(group);
        }
    }
}

ErrorStudy::ErrorStudy(std::span<const Vec3> sites, std::span<const double> values, const ErrorGroups& groups,
                       bool own_variance)
    : sites_(sites),
      values_(values),
      groups_(groups),
      estimate_(sites.size(), missing),
      deviation_(sites.size(), missing) {
    if (!own_variance) {
        local_.emplace(sites, values, groups.of_site);
    }
}

void ErrorStudy::add(std::uint32_t site, double estimate, const Weights& left_out) {
    if (left_out.terms.empty()) {
        return;
    }
    estimate_[site] = estimate;
    if (local_) {
        local_->add(site, estimate - values_[site], left_out);
    } else {
        deviation_[site] = std::sqrt(left_out.variance);
    }
}

void ErrorStudy::learn(const BarrierQuery* barriers) {
    if (local_) {
        local_->pool(barriers);
        local_->forget();
    }
}

void ErrorStudy::judge(const BarrierQuery* barriers, std::span<const Weights> left_out) {
    if (!local_) {
        return;
    }
    local_->pool(barriers);
    tbb::parallel_for(std::size_t{0}, groups_.boreholes.size(), [&](std::size_t group) {
        const auto rates = local_->without(static_cast<std::uint32_t>(group));
        for (std::size_t i = 0; i < sites_.size(); ++i) {
            if (groups_.of_site[i] == group && !left_out[i].terms.empty()) {
                deviation_[i] = local_->standard_deviation(sites_[i], left_out[i], rates);
            }
        }
    });
    local_->forget();
}

Calibration ErrorStudy::calibration(std::optional<std::uint32_t> without) const {
    std::vector<JudgedError> judged;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        if (groups_.of_site[i] != without) {
            judged.push_back({estimate_[i], estimate_[i] - values_[i], deviation_[i]});
        }
    }
    std::size_t boreholes = 0;
    for (std::size_t group = 0; group < groups_.boreholes.size(); ++group) {
        boreholes += group == without ? 0 : groups_.boreholes[group];
    }
    return calibrate(judged, boreholes);
}

Calibration ErrorStudy::calibration() const {
    return calibration(std::nullopt);
}

std::vector<StatedError> ErrorStudy::stated() const {
    std::vector<Calibration> by_others(groups_.boreholes.size());
    tbb::parallel_for(std::size_t{0}, by_others.size(),
                      [&](std::size_t group) { by_others[group] = calibration(static_cast<std::uint32_t>(group)); });
    std::vector<StatedError> out(sites_.size());
    for (std::size_t i = 0; i < sites_.size(); ++i) {
        out[i] = by_others[groups_.of_site[i]].stated(estimate_[i], deviation_[i]);
    }
    return out;
}

}  // namespace terratet
