// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/natural_neighbour.hpp"

#include <cmath>
#include <numeric>
#include <optional>

#include "interp/estimator/query_order.hpp"
#include "interp/natural/cavity.hpp"
#include "interp/natural/changed_places.hpp"
#include "interp/natural/exact_volumes.hpp"
#include "interp/natural/site_gradients.hpp"
#include "interp/natural/slopes.hpp"
#include "interp/sites/facet_block.hpp"
#include "interp/sites/site_mesh.hpp"
#include "interp/sites/sphere_tree.hpp"

namespace terratet {
namespace {

constexpr double position_tolerance = 1e-9;  // of |Σ wp − q|, in radii of the containing cell
constexpr double weight_tolerance = 1e-12;
constexpr double rounding = 1e-10;  // of the distance to the farthest neighbour

/// What one thread needs, kept from query to query.
struct Workspace {
    Cavity cavity;
    FacetBlock block;
    std::vector<double> shares;  ///< one per vertex of the cavity
    StampedMap number;           ///< of each site among the terms
    std::vector<SiteWeight> terms;
};

/// Sibson's identity tells a wrong result from a right one: it holds for the true volumes (and areas over distances),
/// and for hardly any others.
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

/// What the zone's cells had given to its vertices, and what the new cells leave them of it.
void add_cells(const CompactDelaunay& mesh, Workspace& work) {
    for (const std::int32_t id : work.cavity.cells) {
        const auto& vertex = mesh.cells()[static_cast<std::size_t>(id)].vertex;
        const auto& parts = mesh.parts()[static_cast<std::size_t>(id)].of_vertex;
        for (std::size_t k = 0; k < 4; ++k) {
            work.shares[work.cavity.number(vertex[k])] += parts[k];
        }
    }
    for (const std::uint32_t group : work.cavity.groups) {
        for (const auto& [vertex, sum] : mesh.sphere_tree().sums(group)) {
            work.shares[work.cavity.number(vertex)] += sum;
        }
    }
}
void add_boundary(const CompactDelaunay& mesh, const Vec3& q, void (FacetBlock::*terms)(), Workspace& work) {
    const auto& facets = work.cavity.facets;
    const auto& points = work.cavity.points;
    for (std::size_t begin = 0; begin < facets.size(); begin += FacetBlock::lanes) {
        const std::size_t count = std::min(FacetBlock::lanes, facets.size() - begin);
        const auto corner = [&](std::size_t lane, std::size_t k) {
            return static_cast<std::size_t>(facets[begin + lane].vertex[k]);
        };
        for (std::size_t lane = 0; lane < count; ++lane) {
            const auto split = static_cast<std::size_t>(facets[begin + lane].split);
            work.block.set(lane, points[corner(lane, 0)], points[corner(lane, 1)], points[corner(lane, 2)],
                           mesh.cells()[split].center - q);
        }
        (work.block.*terms)();
        for (std::size_t lane = 0; lane < count; ++lane) {
            for (std::size_t k = 0; k < 3; ++k) {
                work.shares[corner(lane, k)] += work.block.term(k, lane);
            }
        }
    }
}

bool shares_in_doubles(const CompactDelaunay& mesh, const Vec3& q, Weighting weighting, Workspace& work) {
    work.shares.assign(work.cavity.points.size(), 0.0);
    if (weighting == Weighting::sibson) {
        add_cells(mesh, work);
        add_boundary(mesh, q, &FacetBlock::sibson, work);
    } else {
        add_boundary(mesh, q, &FacetBlock::laplace, work);
    }
    const double total = std::accumulate(work.shares.begin(), work.shares.end(), 0.0);
    for (double& share : work.shares) {
        share /= total;
    }
    const auto& home = mesh.cells()[static_cast<std::size_t>(work.cavity.home)];
    return acceptable(work, std::sqrt(home.squared_radius));
}

}  // namespace

struct NaturalNeighbour::Impl {
    SiteMesh sites;
    NaturalNeighbourOptions options;
    std::optional<SiteGradients> gradients;

    Impl(const std::vector<Vec3>& places, const BarrierQuery* barriers, NaturalNeighbourOptions given)
        : sites(places, barriers, given.anisotropy), options(given) {
        if (options.smooth) {
            gradients.emplace(sites);
        }
    }

    /// \param start  a cell to walk from; where the walk ended on return
    void estimate(const Vec3& place, std::int32_t& start, Workspace& work, Weights& out) const {
        const SiteQuery query = sites.query(place);
        const auto at = sites.locate(query, start, out);
        if (at.cell < 0) {
            return;
        }
        const Vec3& q = query.within;
        const CompactDelaunay& mesh = sites.tessellation();
        work.cavity.find(mesh, q, at);
        if (!shares_in_doubles(mesh, q, options.weighting, work)) {
            fallback_shares(mesh, work.cavity, q, options.weighting, work.shares);
            out.fallback = true;
        }
        sites.weigh(query, work.cavity.vertices, work.shares, out);
        out.wide = out.wide || !work.cavity.groups.empty();  // whose sums follow the grouping of all cells
        if (gradients && out.terms.size() > 1) {
            add_gradients(query, work, out);
        }
    }

    /// Sibson's C1 estimate: (α Z + β ξ) / (α + β), where Z = Σ λz is the plain estimate, ξ the mean of the sites'
    /// linear fields ζ with weights λ/d, α = Σ λd / Σ λ/d and β = Σ λd².
    void add_gradients(const SiteQuery& query, Workspace& work, Weights& out) const {
        const Vec3& q = query.within;
        const auto points = sites.tessellation().points();
        double by_distance = 0, times_distance = 0, beta = 0;
        for (const auto& [site, weight] : out.terms) {
            const double d = distance(q, points[site]);
            by_distance += weight / d;
            times_distance += weight * d;
            beta += weight * d * d;
        }
        const double alpha = times_distance / by_distance;
        const double part = beta / (alpha + beta) * (1 - out.beyond);  // of ξ

        const Vec3 away = query.at - query.within;
        Vec3 off = (1 - part) * (out.lever - away);  // of Z, then of ξ too
        double farthest = 0;
        work.number.clear(points.size());
        work.terms.clear();
        const auto add = [&](std::uint32_t site, double weight) {
            const auto key = static_cast<std::int32_t>(site);
            if (!work.number.contains(key)) {
                work.number.insert(key, static_cast<std::int32_t>(work.terms.size()));
                work.terms.push_back({site, 0});
            }
            work.terms[static_cast<std::size_t>(work.number[key])].weight += weight;
        };
        for (const auto& [site, weight] : out.terms) {
            const Vec3 from_site = q - points[site];
            const double in_mean = part * weight / (length(from_site) * by_distance);
            add(site, (1 - part) * weight + in_mean);
            double own = 0;
            off = off + in_mean * from_site;
            farthest = std::max(farthest, length(from_site));
            for (const auto& [neighbour, factor] : gradients->of(static_cast<std::int32_t>(site))) {
                const double slope = in_mean * dot(factor, from_site);
                add(static_cast<std::uint32_t>(neighbour), slope);
                own -= slope;
                off = off - slope * (points[static_cast<std::size_t>(neighbour)] - points[site]);
            }
            add(site, own);
        }
        // Where all gradients are determined the mean of the linear fields is off by rounding alone.
        out.lever = out.hidden > 0 || length(off) > rounding * farthest ? off + away : away;
        if (out.lever != Vec3{}) {
            out.slope_terms = out.terms;
        }
        out.terms.assign(work.terms.begin(), work.terms.end());
    }
};

NaturalNeighbour::NaturalNeighbour(std::vector<Vec3> sites, const BarrierQuery* barriers,
                                   NaturalNeighbourOptions options)
    : impl_(std::make_unique<Impl>(sites, barriers, options)) {}

NaturalNeighbour::~NaturalNeighbour() = default;

void NaturalNeighbour::weights(std::span<const ValueQuery> queries, std::span<Weights> out) const {
    in_spatial_order(queries, out, [&](std::span<const std::uint32_t> run) {
        thread_local Workspace work;
        std::int32_t start = run.empty() ? 0 : impl_->sites.start_near(queries[run.front()].position);
        for (const std::uint32_t i : run) {
            impl_->estimate(queries[i].position, start, work, out[i]);
            impl_->sites.number_as_given(out[i]);
        }
    });
}

std::shared_ptr<const Slopes> NaturalNeighbour::slopes(std::vector<std::span<const double>> columns) const {
    return std::make_shared<const Slopes>(impl_->sites, std::move(columns));
}

std::unique_ptr<const ChangedPlaces> NaturalNeighbour::changes_since(const Estimator& before,
                                                                     const ExchangedSites& sites,
                                                                     const Slopes* slopes_before,
                                                                     const Slopes* slopes) const {
    const auto* same = dynamic_cast<const NaturalNeighbour*>(&before);
    if (same == nullptr || impl_->options.smooth || same->impl_->options.smooth) {
        return nullptr;
    }
    return changed_places({same->impl_->sites, *slopes_before}, {impl_->sites, *slopes}, sites);
}

std::size_t NaturalNeighbour::memory_bytes() const {
    return sizeof(Impl) + impl_->sites.memory_bytes() + (impl_->gradients ? impl_->gradients->memory_bytes() : 0);
}

}  // namespace terratet
