// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The sites nearest to a place that can be seen from it: a kd-tree, distances that may be anisotropic, and the faults
/// as walls.

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "interp/anisotropy.hpp"
#include "interp/sites/site_tree.hpp"
#include "interp/sites/ways_round.hpp"
#include "tess/barrier_query.hpp"
#include "tess/value_source.hpp"

namespace terratet {

class SiteIndex {
  public:
    /// \param sites      must outlive the index
    /// \param faults     walls; must outlive the index; may be null
    /// \param boreholes  of each site, for Neighbourhood::per_borehole; empty: none
    SiteIndex(std::span<const Vec3> sites, const BarrierQuery* barriers, const Anisotropy& anisotropy = {},
              std::span<const std::int32_t> boreholes = {});
    SiteIndex(const SiteIndex&) = delete;
    SiteIndex& operator=(const SiteIndex&) = delete;

    /// No fault's sheet between the query and the site?
    [[nodiscard]] bool visible(const ValueQuery& query, std::uint32_t site) const;

    /// The `count` nearest visible sites within `radius` into `out`, nearest first, ties by the sites' coordinates,
    /// hence the same places in any order of sites. What `out` holds from a query of this index nearby bounds the
    /// search from its start. O(count log n), but O(n log n) visibility tests where all sites are hidden.
    void nearest(const ValueQuery& query, std::size_t count, std::vector<NearSite>& out,
                 double radius = std::numeric_limits<double>::infinity()) const;

    /// The same under all the limits of a neighbourhood. Octants are those of the anisotropy's axes.
    void neighbourhood(const ValueQuery& query, const Neighbourhood& limits, std::vector<NearSite>& out) const;

    /// The shortest way round the faults from a place to a site (ways_round.hpp). \param straight  to the nearest that
    /// is visible
    [[nodiscard]] double shortest_way(const ValueQuery& query, double straight) const;

    /// WaysRound::changed_since; none without barriers.
    [[nodiscard]] std::vector<std::pair<Vec3, double>> changed_ways(const SiteIndex& before) const {
        return ways_ && before.ways_ ? ways_->changed_since(*before.ways_) : std::vector<std::pair<Vec3, double>>();
    }

    /// Distances are those in these coordinates.
    [[nodiscard]] const Metric& metric() const { return metric_; }

    /// The sites in these coordinates.
    [[nodiscard]] const SiteTree& tree() const { return tree_; }

    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    std::span<const Vec3> sites_;
    const BarrierQuery* barriers_;
    Metric metric_;
    SiteTree tree_;
    std::unique_ptr<const WaysRound> ways_;  ///< null without faults
};

}  // namespace terratet
