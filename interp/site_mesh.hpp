// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What the estimators that read the sites' Delaunay tessellation share: the sites in Morton order, their tessellation,
/// the faults, and the way from shares of sites and ghosts to weights of visible sites.

#include <cstdint>
#include <span>
#include <vector>

#include "interp/compact_delaunay.hpp"
#include "interp/estimator.hpp"
#include "interp/site_index.hpp"

namespace terratet {

class SiteMesh {
  public:
    /// \pre as make_estimator's
    SiteMesh(const std::vector<Vec3>& sites, const FaultProximity* faults);
    SiteMesh(const SiteMesh&) = delete;
    SiteMesh& operator=(const SiteMesh&) = delete;

    [[nodiscard]] const CompactDelaunay& tessellation() const { return mesh_; }
    [[nodiscard]] bool has_faults() const { return faults_ != nullptr; }

    /// The caller's number of a site of the tessellation.
    [[nodiscard]] std::uint32_t original(std::int32_t vertex) const {
        return original_[static_cast<std::size_t>(vertex)];
    }

    /// 0 where a fault is in the way, 1 where none is near it (FaultProximity::openness).
    [[nodiscard]] double openness(const Vec3& q, std::int32_t vertex) const;

    /// The cell that contains q, or −1 when `out` holds the answer already: on a site, beyond the ghosts' cube (the
    /// nearest visible site), and where q is not finite (no value). \param start  a cell to walk from; where the walk
    /// ended on return
    CompactDelaunay::Location locate(const Vec3& q, std::int32_t& start, Weights& out) const;

    /// Shares that vertices (ghosts among them) have in q, to weights: ghosts' become the extrapolation, sites' count
    /// as far as they are visible and are renormalised; where none is, the nearest visible site. Terms are numbered as
    /// in the tessellation.
    void weigh(const Vec3& q, std::span<const std::int32_t> vertices, std::span<const double> shares,
               Weights& out) const;

    /// From the tessellation's numbers to the caller's.
    void number_as_given(Weights& out) const;

    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    void nearest_visible(const Vec3& q, Weights& out) const;

    std::vector<std::uint32_t> original_;
    CompactDelaunay mesh_;
    const FaultProximity* faults_;
    SiteIndex index_;
};

/// A weighted mean's terms, scaled to sum to 1.
void normalise(std::vector<SiteWeight>& terms);

}  // namespace terratet
