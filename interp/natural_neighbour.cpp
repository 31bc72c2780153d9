// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural_neighbour.hpp"

#include <cmath>
#include <numeric>

#include "interp/cavity.hpp"
#include "interp/exact_volumes.hpp"
#include "interp/facet_block.hpp"
#include "interp/morton.hpp"
#include "interp/query_order.hpp"
#include "interp/site_index.hpp"

namespace terratet {
namespace {

constexpr double position_tolerance = 1e-9;  // of |Σ wp − q|, in radii of the containing cell
constexpr double weight_tolerance = 1e-12;
constexpr double sites_share_min = 1e-6;  // below it, what is left of the sites' weights is rounding

std::vector<Vec3> permuted(const std::vector<Vec3>& places, const std::vector<std::uint32_t>& order) {
    std::vector<Vec3> out(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        out[i] = places[order[i]];
    }
    return out;
}

/// What one thread needs, kept from query to query.
struct Workspace {
    Cavity cavity;
    FacetBlock block;
    std::vector<double> shares;  ///< one per vertex of the cavity
    std::vector<NearSite> near;
};

/// Sibson's identity tells a wrong result from a right one: it holds for the true volumes and for hardly any others.
bool acceptable(const Workspace& work, double radius) {
    Vec3 mean;
    for (std::size_t v = 0; v < work.shares.size(); ++v) {
        if (!(work.shares[v] >= -weight_tolerance)) {
            return false;
        }
        mean = mean + work.shares[v] * work.cavity.points[v];
    }
    return length(mean) <= position_tolerance * radius;
}

bool shares_in_doubles(const CompactDelaunay& mesh, const Vec3& q, Workspace& work, double radius) {
    const Cavity& cavity = work.cavity;
    work.shares.assign(cavity.points.size(), 0.0);
    for (const std::int32_t id : cavity.cells) {
        const auto& vertex = mesh.cells()[static_cast<std::size_t>(id)].vertex;
        const auto& parts = mesh.parts()[static_cast<std::size_t>(id)].of_vertex;
        for (std::size_t k = 0; k < 4; ++k) {
            work.shares[cavity.number(vertex[k])] += parts[k];
        }
    }
    for (std::size_t begin = 0; begin < cavity.facets.size(); begin += FacetBlock::lanes) {
        const std::size_t count = std::min(FacetBlock::lanes, cavity.facets.size() - begin);
        const auto corner = [&](std::size_t lane, std::size_t k) {
            return static_cast<std::size_t>(cavity.facets[begin + lane].vertex[k]);
        };
        for (std::size_t lane = 0; lane < count; ++lane) {
            const auto split = static_cast<std::size_t>(cavity.facets[begin + lane].split);
            work.block.set(lane, cavity.points[corner(lane, 0)], cavity.points[corner(lane, 1)],
                           cavity.points[corner(lane, 2)], mesh.cells()[split].center - q);
        }
        work.block.sibson();
        for (std::size_t lane = 0; lane < count; ++lane) {
            for (std::size_t k = 0; k < 3; ++k) {
                work.shares[corner(lane, k)] += work.block.term(k, lane);
            }
        }
    }
    const double total = std::accumulate(work.shares.begin(), work.shares.end(), 0.0);
    for (double& share : work.shares) {
        share /= total;
    }
    return acceptable(work, radius);
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

}  // namespace

struct NaturalNeighbour::Impl {
    std::vector<std::uint32_t> original;  ///< the caller's number of each site; sites are kept in Morton order
    CompactDelaunay mesh;
    SiteIndex index;

    Impl(const std::vector<Vec3>& sites, std::vector<std::uint32_t> order, const FaultProximity* faults)
        : original(std::move(order)),
          mesh(permuted(sites, original)),
          index(mesh.points().first(sites.size()), faults) {}

    /// \param start  a cell to walk from; where the walk ended on return
    void estimate(const ValueQuery& query, std::int32_t& start, Workspace& work, Weights& out) const {
        const Vec3& q = query.position;
        out.terms.clear();
        out.extrapolation = 0;
        out.fallback = false;
        if (!mesh.within_reach(q)) {
            out.extrapolation = 1;
            nearest_visible(query, work, out);
            return;
        }
        const auto at = mesh.locate(q, start);
        start = at.cell;
        const auto& cell = mesh.cells()[static_cast<std::size_t>(at.cell)];
        if (!at.strictly_inside) {
            for (const std::int32_t v : cell.vertex) {
                if (mesh.points()[static_cast<std::size_t>(v)] == q) {
                    out.terms = {{original[static_cast<std::size_t>(v)], 1.0}};
                    return;
                }
            }
        }
        work.cavity.find(mesh, q, at);
        // Not `cell`: on a facet the walk may have ended on either side.
        const auto& home = mesh.cells()[static_cast<std::size_t>(work.cavity.cells.front())];
        if (!shares_in_doubles(mesh, q, work, std::sqrt(home.squared_radius))) {
            exact_shares(mesh, work.cavity, q, work.shares);
            out.fallback = true;
        }
        collect(query, work, out);
    }

    /// From the cavity's shares to visible sites' weights.
    void collect(const ValueQuery& query, Workspace& work, Weights& out) const {
        double ghosts = 0;
        bool any_site = false;
        for (std::size_t v = 0; v < work.shares.size(); ++v) {
            const double share = work.shares[v];
            if (share <= 0) {
                continue;
            }
            const std::int32_t vertex = work.cavity.vertices[v];
            if (mesh.is_ghost(vertex)) {
                ghosts += share;
                continue;
            }
            any_site = true;
            if (index.visible(query, static_cast<std::uint32_t>(vertex))) {
                out.terms.push_back({original[static_cast<std::size_t>(vertex)], share});
            }
        }
        out.extrapolation = std::min(ghosts, 1.0);
        if (!any_site || ghosts > 1 - sites_share_min) {
            out.extrapolation = 1;
            out.terms.clear();
        }
        if (out.terms.empty()) {
            nearest_visible(query, work, out);
        } else {
            normalise(out.terms);
        }
    }

    void nearest_visible(const ValueQuery& query, Workspace& work, Weights& out) const {
        out.fallback = true;
        index.nearest(query, 1, work.near);
        if (!work.near.empty()) {
            out.terms = {{original[work.near.front().site], 1.0}};
        }
    }
};

NaturalNeighbour::NaturalNeighbour(std::vector<Vec3> sites, const FaultProximity* faults)
    : impl_(std::make_unique<Impl>(sites, morton_order(sites), faults)) {}

NaturalNeighbour::~NaturalNeighbour() = default;

void NaturalNeighbour::weights(std::span<const ValueQuery> queries, std::span<Weights> out) const {
    in_spatial_order(queries, [&](std::span<const std::uint32_t> run) {
        thread_local Workspace work;
        std::int32_t start = run.empty() ? 0 : impl_->mesh.start_near(queries[run.front()].position);
        for (const std::uint32_t i : run) {
            impl_->estimate(queries[i], start, work, out[i]);
        }
    });
}

std::size_t NaturalNeighbour::memory_bytes() const {
    return sizeof(Impl) + impl_->original.capacity() * sizeof(std::uint32_t) + impl_->mesh.memory_bytes() +
           impl_->index.memory_bytes();
}

}  // namespace terratet
