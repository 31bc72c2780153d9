// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terratet {
namespace {

constexpr double spread_min = 1.0 / 30;  // along an axis, of that along the widest
constexpr std::size_t rings_min = 2;
constexpr std::size_t ring_enough = 64;      // sites seen; then the first ring does
constexpr std::size_t sites_enough = 128;    // sites seen; then the rest of a further ring need not be asked for
constexpr std::size_t rings_reach = 1000;    // sites asked for in rings
constexpr std::size_t farther_reach = 4000;  // sites looked at by distance: all are asked for
constexpr std::size_t farther_all = 500;     // up to here,
constexpr std::size_t farther_one_in = 8;    // and then one in so many
constexpr std::uint32_t farther_per_octant = 4;
constexpr double thickness_doubt = 4;  // squared: an exchange of sites may make them so much thinner

Eigen::Vector3d vector_of(const Vec3& v) {
    return {v.x, v.y, v.z};
}

}  // namespace

Spread::Spread(const Eigen::Matrix3d& moments)
    : axes_(moments), least_(spread_min * spread_min * axes_.eigenvalues()[2]) {}

Eigen::Matrix3d Spread::moments(std::span<const Seen> seen) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Seen& s : seen) {
        sum += s.weight * s.offset * s.offset.transpose();
    }
    return sum;
}

thread_local StampedSet Surroundings::number_;

Surroundings::Surroundings(const SiteMesh& sites, const SheetSides& sides, const Stars& stars, std::int32_t site)
    : sites_(sites), sides_(sides), stars_(stars), points_(sites.tessellation().points()), site_(site) {
    number_.clear(points_.size());
    number_.insert(site);
    ring_ = {site};
    sides.squared_distances(site, sheet_distances_);
}

const std::vector<Seen>& Surroundings::look() {
    for (std::size_t ring = 1; asked_ < rings_reach && next_ring(); ++ring) {
        if (look_at_ring(ring)) {
            return seen_;
        }
    }
    take_across();
    if (!enough()) {
        look_farther();
        take_across();
    }
    return seen_;
}

/// True when what was seen is enough.
bool Surroundings::look_at_ring(std::size_t ring) {
    ring_.clear();
    for (const auto& [squared_distance, vertex] : next_) {
        const bool open = ask(vertex);
        if (open || ring < rings_min) {  // what is hidden in the first ring may be all there is
            ring_.push_back(vertex);
        }
        if (open && ring > 1 && seen_.size() >= sites_enough && seen_.size() % ring_enough == 0 && enough()) {
            return true;
        }
    }
    if (ring < rings_min && seen_.size() < ring_enough) {
        return false;
    }
    if (!enough() && ring > rings_min) {
        take_across();
    }
    return enough();
}

/// What lies around the last ring, nearest first. False at the end of all.
bool Surroundings::next_ring() {
    next_.clear();
    const CompactDelaunay& mesh = sites_.tessellation();
    for (const std::int32_t from : ring_) {
        for (const std::int32_t cell : stars_.of(from)) {
            for (const std::int32_t v : mesh.cells()[static_cast<std::size_t>(cell)].vertex) {
                if (!number_.contains(v) && !mesh.is_ghost(v)) {
                    number_.insert(v);
                    next_.emplace_back(squared_distance(point(site_), point(v)), v);
                }
            }
        }
    }
    std::sort(next_.begin(), next_.end());
    if (!next_.empty()) {
        reached_ = next_.front().first;
    }
    return !next_.empty();
}

/// Neighbours tell too little: what is seen over them, on all sides.
void Surroundings::look_farther() {
    squared_reach_ = std::numeric_limits<double>::infinity();
    std::size_t looked_at = 0;
    const auto usable = [&](std::uint32_t i) {
        const auto vertex = static_cast<std::int32_t>(i);
        if (number_.contains(vertex)) {
            return false;
        }
        ++looked_at;
        return (looked_at <= farther_all || looked_at % farther_one_in == 0) && ask(vertex);
    };
    std::vector<NearSite> near;
    sites_.tree().neighbourhood(point(site_),
                                {.max_points = 8 * farther_per_octant,
                                 .per_octant = farther_per_octant,
                                 .max_looked_at = farther_reach + asked_},
                                usable, near);
}

bool Surroundings::enough() {
    const Eigen::Matrix3d moments = Spread::moments(seen_);
    return Spread(moments).determines_all() || nothing_left(moments);
}

/// Is every axis determined but those along which no site at the last ring's distance or beyond would help?
bool Surroundings::nothing_left(Eigen::Matrix3d moments) {
    // Where the sites are H thick along an axis, one at distance r adds along it at most H²/r² of what it adds to the
    // trace, a third of which the widest has at least. What has too little along the axis, and is given no more by any
    // further site than too little, stays so: the axis is then counted as wide.
    const double share = spread_min * spread_min / 3, all = moments.trace();
    const PrincipalBox& box = sites_.principal_box();
    bool thin = false;
    for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d axis = vector_of(box.axis(i));
        const double thickness = box.thickness(i);
        if (thickness * thickness <= thickness_doubt * share * reached_) {
            squared_reach_ = std::numeric_limits<double>::infinity();
        }
        if (box.thickness(i) * box.thickness(i) <= share * reached_ && axis.dot(moments * axis) <= share * all) {
            thin = true;
            moments += all * axis * axis.transpose();
        }
    }
    return thin && Spread(moments).determines_all();
}

/// Is it seen?
bool Surroundings::ask(std::int32_t vertex) {
    ++asked_;
    squared_reach_ = std::max(squared_reach_, squared_distance(point(site_), point(vertex)));
    const double open = sites_.openness(sites_.place(site_), vertex);
    if (open > 0) {
        const Vec3 d = point(vertex) - point(site_);
        auto& list = sides_.part(site_, vertex, sheet_distances_) ? across_ : seen_;
        list.push_back({vertex, vector_of(d), open / length(d)});
    }
    return open > 0;
}

void Surroundings::take_across() {
    seen_.insert(seen_.end(), across_.begin(), across_.end());
    across_.clear();
}

}  // namespace terratet
