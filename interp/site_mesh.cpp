// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/site_mesh.hpp"

#include <algorithm>

#include "interp/morton.hpp"

namespace terratet {
namespace {

constexpr double sites_share_min = 1e-6;  // below it, what is left of the sites' weights is rounding

std::vector<Vec3> permuted(const std::vector<Vec3>& places, const std::vector<std::uint32_t>& order) {
    std::vector<Vec3> out(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        out[i] = places[order[i]];
    }
    return out;
}

}  // namespace

SiteMesh::SiteMesh(const std::vector<Vec3>& sites, const FaultProximity* faults)
    : original_(morton_order(sites)),
      mesh_(permuted(sites, original_)),
      faults_(faults && !faults->empty() ? faults : nullptr),
      index_(mesh_.points().first(sites.size()), faults) {}

double SiteMesh::openness(const Vec3& q, std::int32_t vertex) const {
    if (!faults_) {
        return 1;
    }
    return faults_->openness(q, mesh_.points()[static_cast<std::size_t>(vertex)]);
}

CompactDelaunay::Location SiteMesh::locate(const Vec3& q, std::int32_t& start, Weights& out) const {
    constexpr CompactDelaunay::Location answered{-1, false};
    out.terms.clear();
    out.extrapolation = 0;
    out.fallback = false;
    if (!mesh_.within_reach(q)) {
        out.extrapolation = 1;
        if (!is_finite(q)) {
            return answered;
        }
        nearest_visible(q, out);
        return answered;
    }
    const auto at = mesh_.locate(q, start);
    start = at.cell;
    if (!at.strictly_inside) {
        for (const std::int32_t v : mesh_.cells()[static_cast<std::size_t>(at.cell)].vertex) {
            if (mesh_.points()[static_cast<std::size_t>(v)] == q) {
                out.terms = {{static_cast<std::uint32_t>(v), 1.0}};
                return answered;
            }
        }
    }
    return at;
}

void SiteMesh::weigh(const Vec3& q, std::span<const std::int32_t> vertices, std::span<const double> shares,
                     Weights& out) const {
    double ghosts = 0;
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
        const double weight = shares[v] * openness(q, vertices[v]);
        if (weight > 0) {
            out.terms.push_back({static_cast<std::uint32_t>(vertices[v]), weight});
        }
    }
    out.extrapolation = std::min(ghosts, 1.0);
    if (!any_site || ghosts > 1 - sites_share_min) {
        out.extrapolation = 1;
        out.terms.clear();
    }
    if (out.terms.empty()) {
        nearest_visible(q, out);
    } else {
        normalise(out.terms);
    }
}

void SiteMesh::number_as_given(Weights& out) const {
    for (auto& term : out.terms) {
        term.site = original_[term.site];
    }
}

void SiteMesh::nearest_visible(const Vec3& q, Weights& out) const {
    out.fallback = true;
    thread_local std::vector<NearSite> near;
    index_.nearest(ValueQuery{q}, 1, near);
    if (!near.empty()) {
        out.terms = {{near.front().site, 1.0}};
    }
}

std::size_t SiteMesh::memory_bytes() const {
    return sizeof(*this) + original_.capacity() * sizeof(std::uint32_t) + mesh_.memory_bytes() + index_.memory_bytes();
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
