// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/extrapolation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "interp/anisotropy.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/kriging/kriging_spec.hpp"
#include "interp/base/morton.hpp"
#include "interp/sites/site_tree.hpp"

namespace terratet {
namespace {

constexpr double spacings_reached = 3;
constexpr std::size_t asked_max = 1000;

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ssize(values) / 2;
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The median distance between what was sampled together and its neighbours; 0 where there is none.
double spacing_of(const std::vector<Vec3>& places, std::span<const std::int32_t> boreholes) {
    const SiteTree tree(places, boreholes);
    const auto order = morton_order(places);
    const std::size_t asked = std::min(order.size(), asked_max);
    std::vector<double> spacings;
    std::vector<NearSite> near;
    for (std::size_t k = 0; k < asked; ++k) {
        const std::uint32_t i = order[k * order.size() / asked];
        const bool loose = boreholes.empty() || boreholes[i] < 0;
        const auto other = [&](std::uint32_t j) { return loose ? j != i : boreholes[j] != boreholes[i]; };
        tree.neighbourhood(places[i], {.max_points = loose ? 3U : 1U, .per_octant = loose ? 1U : 0U}, other, near);
        if (!near.empty()) {
            spacings.push_back(std::sqrt(near.back().squared_distance));
        }
    }
    return spacings.empty() ? 0 : median(std::move(spacings));
}

}  // namespace

double reach_of(const EstimatorSpec& spec, std::span<const Vec3> sites, std::span<const std::int32_t> boreholes) {
    if (const auto range = range_of(spec)) {
        return *range;
    }
    std::vector<Vec3> places(sites.size());
    std::transform(sites.begin(), sites.end(), places.begin(), Metric(anisotropy_of(spec)));
    const double spacing = spacing_of(places, boreholes);
    return spacing > 0 ? spacings_reached * spacing : 0.5 * bounding_box(places).diagonal();
}

double extrapolation_at(double distance, double reach) {
    return distance < 2 * reach ? distance / (2 * reach) : distance > 0 ? 1 : 0;
}

}  // namespace terratet
