// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/site_index.hpp"

#include <algorithm>
#include <cmath>

namespace terratet {
namespace {

constexpr int looks_max = 256;  ///< from a place that may see nothing

SiteTree tree_of(std::span<const Vec3> sites, const Metric& metric, const Anisotropy& anisotropy,
                 std::span<const std::int32_t> boreholes) {
    if (anisotropy.isotropic()) {
        return SiteTree(sites, boreholes);
    }
    std::vector<Vec3> places(sites.size());
    std::transform(sites.begin(), sites.end(), places.begin(), metric);
    return SiteTree(places, boreholes);
}

}  // namespace

SiteIndex::SiteIndex(std::span<const Vec3> sites, const BarrierQuery* barriers, const Anisotropy& anisotropy,
                     std::span<const std::int32_t> boreholes)
    : sites_(sites),
      barriers_(barriers && !barriers->empty() ? barriers : nullptr),
      metric_(anisotropy),
      tree_(tree_of(sites, metric_, anisotropy, boreholes)) {
    if (barriers_) {
        ways_ = std::make_unique<const WaysRound>(*barriers_, metric_, [this](const Vec3& place) {
            int looks = 0;
            std::vector<NearSite> near;
            tree_.neighbourhood(
                metric_(place), {.max_points = 1},
                [&](std::uint32_t site) { return ++looks <= looks_max && visible({place}, site); }, near);
            return near.empty() ? std::numeric_limits<double>::infinity() : std::sqrt(near.front().squared_distance);
        });
    }
}

bool SiteIndex::visible(const ValueQuery& query, std::uint32_t site) const {
    return !barriers_ || sites_[site] == query.position || !barriers_->crosses_any(query.position, sites_[site]);
}

void SiteIndex::nearest(const ValueQuery& query, std::size_t count, std::vector<NearSite>& out, double radius) const {
    neighbourhood(query, {count, radius, 0, 0}, out);
}

void SiteIndex::neighbourhood(const ValueQuery& query, const Neighbourhood& limits, std::vector<NearSite>& out) const {
    const Vec3 place = metric_(query.position);
    if (!barriers_ && limits.per_octant == 0 && limits.per_borehole == 0) {
        tree_.nearest(place, limits.max_points, limits.radius * limits.radius, out);
    } else {
        tree_.neighbourhood(
            place, limits, [&](std::uint32_t site) { return visible(query, site); }, out);
    }
}

double SiteIndex::shortest_way(const ValueQuery& query, double straight) const {
    return ways_ ? ways_->shorter(query.position, straight) : straight;
}

std::size_t SiteIndex::memory_bytes() const {
    return tree_.memory_bytes();
}

}  // namespace terratet
