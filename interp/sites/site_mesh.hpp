// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What the estimators that read the sites' Delaunay tessellation share: the sites in Morton order, their tessellation,
/// the faults, and the way from shares of sites and ghosts to weights of visible sites.
///
/// Beyond the sites' box a place has the shares of the nearest place of the box: neighbours near by, few of them, and
/// continuous everywhere; what is hidden, the lever and the distance are its own.
///
/// With an anisotropy everything is done in its metric's coordinates, ghosts and extrapolation as well, but for what
/// faults hide: sight is along straight lines either way, and faults are where they are.

#include <cstdint>
#include <span>
#include <vector>

#include "interp/anisotropy.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/sites/compact_delaunay.hpp"
#include "interp/sites/principal_box.hpp"
#include "interp/sites/site_index.hpp"
#include "tess/barrier_query.hpp"

namespace terratet {

/// A query, and where it is in the tessellation's coordinates.
struct SiteQuery {
    Vec3 place;
    Vec3 at;
    Vec3 within;  ///< the place of the sites' box whose shares it has: the nearest, or about
};

class SiteMesh {
  public:
    /// \pre as make_estimator's. Throws UsageError where the anisotropy is so strong that sites coincide or lie beyond
    /// acceptable coordinates.
    SiteMesh(const std::vector<Vec3>& sites, const BarrierQuery* barriers, const Anisotropy& anisotropy = {});
    SiteMesh(const SiteMesh&) = delete;
    SiteMesh& operator=(const SiteMesh&) = delete;

    [[nodiscard]] const CompactDelaunay& tessellation() const { return mesh_; }
    [[nodiscard]] SiteQuery query(const Vec3& place) const {
        const Vec3 at = index_.metric()(place);
        return {place, at, principal_.flat_and_tilted() ? within_tilted(at) : mesh_.box().clamped(at)};
    }
    /// Of the sites in the tessellation's coordinates.
    [[nodiscard]] const PrincipalBox& principal_box() const { return principal_; }
    /// The barriers; null for none.
    [[nodiscard]] const BarrierQuery* barriers() const { return barriers_; }

    /// The caller's number of a site of the tessellation.
    [[nodiscard]] std::uint32_t original(std::int32_t vertex) const {
        return original_[static_cast<std::size_t>(vertex)];
    }

    /// A cell near a place to start a walk from.
    [[nodiscard]] std::int32_t start_near(const Vec3& place) const { return mesh_.start_near(query(place).within); }

    /// Of a site of the tessellation.
    [[nodiscard]] const Vec3& place(std::int32_t vertex) const {
        return places_.empty() ? mesh_.points()[static_cast<std::size_t>(vertex)]
                               : places_[static_cast<std::size_t>(vertex)];
    }

    /// The sites by the tessellation's numbers, in its coordinates.
    [[nodiscard]] const SiteTree& tree() const { return index_.tree(); }

    [[nodiscard]] const SiteIndex& index() const { return index_; }

    /// 0 where a fault is in the way, 1 where none is near it (BarrierQuery::openness).
    [[nodiscard]] double openness(const Vec3& place, std::int32_t vertex) const;

    /// The cell that contains q.within, or −1 when `out` holds the answer already: where that is a site, and where q is
    /// not finite (no value). \param start  a cell to walk from; where the walk
    /// ended on return. `out` is cleared.
    CompactDelaunay::Location locate(const SiteQuery& q, std::int32_t& start, Weights& out) const;

    /// Shares that vertices (ghosts among them) have in q, to weights: sites' count as far as they are visible and are
    /// renormalised, with the lever to what they had been; where none is, the nearest visible site. Terms are numbered
    /// as in the tessellation.
    void weigh(const SiteQuery& q, std::span<const std::int32_t> vertices, std::span<const double> shares,
               Weights& out) const;

    /// From the tessellation's numbers to the caller's.
    void number_as_given(Weights& out) const;

    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    /// \param at  the sites in the tessellation's coordinates
    SiteMesh(const std::vector<Vec3>& sites, const std::vector<Vec3>& at, const BarrierQuery* barriers,
             const Anisotropy& anisotropy);
    [[nodiscard]] Vec3 within_tilted(const Vec3& at) const;
    void nearest_visible(const SiteQuery& q, Weights& out) const;
    /// Round barriers. \param most  that of one that is visible
    [[nodiscard]] double way_to_site(const SiteQuery& q, double most) const;

    std::vector<std::uint32_t> original_;
    std::vector<Vec3> places_;  ///< of the sites, in the tessellation's order; empty: as in the tessellation
    CompactDelaunay mesh_;
    PrincipalBox principal_;
    const BarrierQuery* barriers_;
    SiteIndex index_;
};

/// A weighted mean's terms, scaled to sum to 1.
void normalise(std::vector<SiteWeight>& terms);

}  // namespace terratet
