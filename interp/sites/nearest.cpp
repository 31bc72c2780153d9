// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/nearest.hpp"

#include <cmath>

#include "interp/estimator/query_order.hpp"

namespace terratet {

Nearest::Nearest(std::vector<Vec3> sites, const BarrierQuery* barriers, const Anisotropy& anisotropy)
    : sites_(std::move(sites)), index_(sites_, barriers, anisotropy) {}

void Nearest::weights(std::span<const ValueQuery> queries, std::span<Weights> out) const {
    in_spatial_order(queries, out, [&](std::span<const std::uint32_t> run) {
        std::vector<NearSite> near;
        for (const std::uint32_t i : run) {
            index_.nearest(queries[i], 1, near);
            out[i].clear();
            if (!near.empty()) {
                out[i].distance = index_.shortest_way(queries[i], std::sqrt(near.front().squared_distance));
                out[i].terms.push_back({near.front().site, 1.0});
            }
        }
    });
}

}  // namespace terratet
