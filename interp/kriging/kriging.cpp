// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/kriging/kriging.hpp"

#include <algorithm>
#include <cmath>

#include "interp/estimator/query_order.hpp"

namespace terratet {
namespace {

/// What one run of near queries shares: often they have the same neighbours, whose factor then serves again.
struct Workspace {
    KrigingSystem system;
    std::vector<NearSite> near;
    std::vector<std::uint32_t> neighbours;  ///< by index, so that a factor does not depend on the query
    std::vector<std::uint32_t> factored;
    std::vector<Vec3> places;   ///< of the neighbours, in the metric
    std::vector<Vec3> offsets;  ///< from the query
    std::vector<double> weights;
};

void by_inverse_squares(const std::vector<NearSite>& near, std::vector<SiteWeight>& terms) {
    double sum = 0;
    for (const auto& [squared_distance, site, slot] : near) {
        terms.push_back({site, near.front().squared_distance / squared_distance});
        sum += terms.back().weight;
    }
    for (auto& term : terms) {
        term.weight /= sum;
    }
}

}  // namespace

Kriging::Kriging(std::vector<Vec3> sites, const BarrierQuery* barriers, const KrigingOptions& options,
                 std::span<const std::int32_t> boreholes)
    : sites_(std::move(sites)), index_(sites_, barriers, options.variogram.anisotropy, boreholes), options_(options) {}

void Kriging::weights(std::span<const ValueQuery> queries, std::span<Weights> out) const {
    const double variance = options_.variogram.nugget + options_.variogram.sill;
    const auto estimate = [&](const ValueQuery& query, Workspace& work, Weights& result) {
        index_.neighbourhood(query, options_.neighbourhood, work.near);
        result.clear();
        if (work.near.empty()) {
            return;
        }
        result.distance = index_.shortest_way(query, std::sqrt(work.near.front().squared_distance));
        if (work.near.front().squared_distance == 0) {
            result.terms.push_back({work.near.front().site, 1.0});
            result.variance = 0;
            return;
        }
        work.neighbours.clear();
        for (const auto& near : work.near) {
            work.neighbours.push_back(near.site);
        }
        std::sort(work.neighbours.begin(), work.neighbours.end());
        if (work.neighbours != work.factored) {
            work.places.clear();
            for (const std::uint32_t site : work.neighbours) {
                work.places.push_back(index_.metric()(sites_[site]));
            }
            work.system.set_places(work.places);
            work.factored = work.neighbours;
        }
        work.offsets.clear();
        for (const std::uint32_t site : work.neighbours) {
            work.offsets.push_back(sites_[site] - query.position);
        }
        KrigingSystem::Result solved;
        if (!work.system.solve(index_.metric()(query.position), work.offsets, work.weights, solved)) {
            by_inverse_squares(work.near, result.terms);
            result.beyond = 1;
            result.fallback = true;
            result.variance = variance;
            return;
        }
        for (std::size_t k = 0; k < work.neighbours.size(); ++k) {
            result.terms.push_back({work.neighbours[k], work.weights[k]});
        }
        result.beyond = solved.mean_share;
        result.fallback = solved.fallback;
        result.variance = variance * solved.variance;
    };
    in_spatial_order(queries, out, [&](std::span<const std::uint32_t> run) {
        Workspace work{KrigingSystem(options_.variogram, options_.drift), {}, {}, {}, {}, {}, {}};
        for (const std::uint32_t i : run) {
            estimate(queries[i], work, out[i]);
        }
    });
}

std::size_t Kriging::memory_bytes() const {
    return sizeof(Kriging) + sites_.capacity() * sizeof(Vec3) + index_.memory_bytes();
}

}  // namespace terratet
