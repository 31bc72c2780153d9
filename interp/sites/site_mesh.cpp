// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/site_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "interp/base/morton.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr double box_margin = 0.05;       // in diagonals, that cells reach beyond the sites' box on any side
constexpr double sites_share_min = 1e-6;  // below it, what is left of the sites' weights is rounding

std::vector<Vec3> permuted(const std::vector<Vec3>& places, const std::vector<std::uint32_t>& order) {
    std::vector<Vec3> out(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        out[i] = places[order[i]];
    }
    return out;
}

/// Where the sites are in the metric's coordinates.
std::vector<Vec3> in_metric(const std::vector<Vec3>& sites, const Anisotropy& anisotropy) {
    if (anisotropy.isotropic()) {
        return sites;
    }
    std::vector<Vec3> at(sites.size());
    std::transform(sites.begin(), sites.end(), at.begin(), Metric(anisotropy));
    std::vector<Vec3> sorted = at;
    std::sort(sorted.begin(), sorted.end());
    if (!std::all_of(at.begin(), at.end(), is_acceptable) ||
        std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
        throw UsageError("ratio2 and ratio3 are so far from 1 that samples can no longer be told apart; take others");
    }
    return at;
}

}  // namespace

SiteMesh::SiteMesh(const std::vector<Vec3>& sites, const BarrierQuery* barriers, const Anisotropy& anisotropy)
    : SiteMesh(sites, in_metric(sites, anisotropy), barriers, anisotropy) {}

SiteMesh::SiteMesh(const std::vector<Vec3>& sites, const std::vector<Vec3>& at, const BarrierQuery* barriers,
                   const Anisotropy& anisotropy)
    : original_(morton_order(at)),
      places_(anisotropy.isotropic() ? std::vector<Vec3>() : permuted(sites, original_)),
      mesh_(permuted(at, original_)),
      principal_(mesh_.points().first(sites.size())),
      barriers_(barriers && !barriers->empty() ? barriers : nullptr),
      index_(places_.empty() ? mesh_.points().first(sites.size()) : std::span<const Vec3>(places_), barriers,
             anisotropy) {}

/// A plane of samples has all of them for neighbours of a place above it, so the place's foot on the plane stands for
/// it. The principal box's corners may lie beyond the reach of cells: from there towards the sites' mean.
Vec3 SiteMesh::within_tilted(const Vec3& at) const {
    const Vec3 foot = principal_.clamped(at);
    const Vec3& mean = principal_.mean();
    const Box3 box = mesh_.box().grown(box_margin * mesh_.box().diagonal());
    double part = 1;
    for (int i = 0; i < 3; ++i) {
        const double away = foot[i] - mean[i];
        const double room = away > 0 ? box.hi[i] - mean[i] : mean[i] - box.lo[i];
        part = std::abs(away) > room ? std::min(part, room / std::abs(away)) : part;
    }
    // Of sites that differ in their last bits rounding leads out of the box.
    return box.clamped(part < 1 ? mean + part * (foot - mean) : foot);
}

double SiteMesh::openness(const Vec3& from, std::int32_t vertex) const {
    return barriers_ ? barriers_->openness(from, place(vertex)) : 1;
}

CompactDelaunay::Location SiteMesh::locate(const SiteQuery& q, std::int32_t& start, Weights& out) const {
    constexpr CompactDelaunay::Location answered{-1, false};
    out.clear();
    if (!is_finite(q.at)) {
        out.beyond = 1;
        return answered;
    }
    const auto at = mesh_.locate(q.within, start);
    start = at.cell;
    if (!at.strictly_inside) {
        for (const std::int32_t v : mesh_.cells()[static_cast<std::size_t>(at.cell)].vertex) {
            if (mesh_.points()[static_cast<std::size_t>(v)] != q.within) {
                continue;
            }
            if (q.within == q.at) {
                out.terms = {{static_cast<std::uint32_t>(v), 1.0}};
                out.distance = 0;
            } else {
                weigh(q, std::array{v}, std::array{1.0}, out);
            }
            return answered;
        }
    }
    return at;
}

void SiteMesh::weigh(const SiteQuery& q, std::span<const std::int32_t> vertices, std::span<const double> shares,
                     Weights& out) const {
    double ghosts = 0, hidden = 0;
    bool any_site = false;
    for (std::size_t v = 0; v < shares.size(); ++v) {
        if (!(shares[v] > 0)) {
            continue;
        }
        if (mesh_.is_ghost(vertices[v])) {
            ghosts += shares[v];
            continue;
        }
        any_site = true;
        const double weight = shares[v] * openness(q.place, vertices[v]);
        hidden += shares[v] - weight;
        if (weight > 0) {
            out.terms.push_back({static_cast<std::uint32_t>(vertices[v]), weight});
        }
    }
    out.beyond = std::min(ghosts, 1.0);
    out.hidden = std::min(ghosts + hidden, 1.0);
    if (!any_site || ghosts > 1 - sites_share_min) {
        out.beyond = 1;
        out.terms.clear();
    }
    if (out.terms.empty()) {
        nearest_visible(q, out);
        return;
    }
    normalise(out.terms);
    const bool has_lever = out.hidden > 0 || q.within != q.at;
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [site, weight] : out.terms) {
        const Vec3 away = q.at - mesh_.points()[site];
        nearest = std::min(nearest, squared_length(away));
        if (has_lever) {
            out.lever = out.lever + weight * away;
        }
    }
    out.distance = way_to_site(q, std::sqrt(nearest));
}

void SiteMesh::number_as_given(Weights& out) const {
    for (auto* list : {&out.terms, &out.slope_terms}) {
        for (auto& term : *list) {
            term.site = original_[term.site];
        }
    }
}

void SiteMesh::nearest_visible(const SiteQuery& q, Weights& out) const {
    out.fallback = true;
    out.wide = true;
    out.hidden = 1;
    thread_local std::vector<NearSite> near;
    near.clear();
    index_.nearest(ValueQuery{q.place}, 1, near);
    if (!near.empty()) {
        out.terms = {{near.front().site, 1.0}};
        out.distance = index_.shortest_way({q.place}, std::sqrt(near.front().squared_distance));
        out.lever = q.at - mesh_.points()[near.front().site];
    }
}

double SiteMesh::way_to_site(const SiteQuery& q, double most) const {
    thread_local std::vector<NearSite> near;
    near.clear();
    index_.nearest(ValueQuery{q.place}, 1, near, most);
    return index_.shortest_way({q.place}, near.empty() ? most : std::sqrt(near.front().squared_distance));
}

std::size_t SiteMesh::memory_bytes() const {
    return sizeof(*this) + original_.capacity() * sizeof(std::uint32_t) + places_.capacity() * sizeof(Vec3) +
           mesh_.memory_bytes() + index_.memory_bytes();
}

void normalise(std::vector<SiteWeight>& terms) {
    double sum = 0;
    for (const auto& term : terms) {
        sum += term.weight;
    }
    for (auto& term : terms) {
        term.weight /= sum;
    }
}

}  // namespace terratet
