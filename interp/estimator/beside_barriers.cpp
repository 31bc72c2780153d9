// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator/beside_barriers.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <set>

namespace terratet {

std::vector<ValueQuery> beside_barriers(std::span<const ValueQuery> queries, const BarrierQuery& barriers) {
    std::vector<ValueQuery> placed(queries.begin(), queries.end());
    if (!barriers.empty()) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, placed.size(), 256), [&](const auto& part) {
            for (std::size_t i = part.begin(); i != part.end(); ++i) {
                if (is_finite(placed[i].position)) {
                    placed[i].position = barriers.off_barriers(placed[i].position, placed[i].barrier, placed[i].side);
                }
            }
        });
    }
    return placed;
}

std::vector<Vec3> beside_barriers(std::vector<Vec3> sites, const BarrierQuery& barriers) {
    std::vector<ValueQuery> queries(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
        queries[i].position = sites[i];
    }
    const std::vector<ValueQuery> placed = beside_barriers(queries, barriers);
    std::set<Vec3> taken;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (placed[i].position == sites[i]) {
            continue;
        }
        if (taken.empty()) {
            taken.insert(sites.begin(), sites.end());
        }
        if (taken.insert(placed[i].position).second) {
            sites[i] = placed[i].position;
        }
    }
    return sites;
}

}  // namespace terratet
