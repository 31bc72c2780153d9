// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/idw.hpp"

#include <cmath>

#include "interp/estimator/query_order.hpp"

namespace terratet {
namespace {

/// \param near  not empty, nearest first. Distances are taken relative to the nearest: no power overflows.
void weigh(const std::vector<NearSite>& near, double power, std::vector<SiteWeight>& terms) {
    const double nearest = near.front().squared_distance;
    if (nearest == 0) {
        terms = {{near.front().site, 1.0}};
        return;
    }
    double sum = 0;
    for (const auto& [squared_distance, site, slot] : near) {
        const double ratio = nearest / squared_distance;
        const double weight = power == 2 ? ratio : std::pow(ratio, power / 2);
        terms.push_back({site, weight});
        sum += weight;
    }
    for (auto& term : terms) {
        term.weight /= sum;
    }
}

}  // namespace

InverseDistance::InverseDistance(std::vector<Vec3> sites, const BarrierQuery* barriers, const IdwOptions& options,
                                 std::span<const std::int32_t> boreholes)
    : sites_(std::move(sites)), index_(sites_, barriers, options.anisotropy, boreholes), options_(options) {}

void InverseDistance::weights(std::span<const ValueQuery> queries, std::span<Weights> out) const {
    in_spatial_order(queries, out, [&](std::span<const std::uint32_t> run) {
        std::vector<NearSite> near;
        for (const std::uint32_t i : run) {
            index_.neighbourhood(queries[i], options_.neighbourhood, near);
            out[i].clear();
            if (!near.empty()) {
                out[i].distance = index_.shortest_way(queries[i], std::sqrt(near.front().squared_distance));
                weigh(near, options_.power, out[i].terms);
            }
        }
    });
}

}  // namespace terratet
