// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The sites nearest to a place that can be seen from it: a kd-tree (nanoflann) and the faults as walls.

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "tess/fault_proximity.hpp"
#include "tess/value_source.hpp"

namespace terratet {

struct NearSite {
    double squared_distance;
    std::uint32_t site;
};

class SiteIndex {
  public:
    /// \param sites   must outlive the index
    /// \param faults  walls; must outlive the index; may be null
    SiteIndex(std::span<const Vec3> sites, const FaultProximity* faults);
    ~SiteIndex();

    /// No fault's sheet between the query and the site?
    [[nodiscard]] bool visible(const ValueQuery& query, std::uint32_t site) const;

    /// The `count` nearest visible sites within `radius` into `out`, nearest first, ties by the sites' coordinates,
    /// hence the same places in any order of sites. O(count log n), but O(n log n) visibility tests where all sites are
    /// hidden.
    void nearest(const ValueQuery& query, std::size_t count, std::vector<NearSite>& out,
                 double radius = std::numeric_limits<double>::infinity()) const;

    [[nodiscard]] std::size_t memory_bytes() const;

  private:
    struct Tree;
    std::span<const Vec3> sites_;
    const FaultProximity* faults_;
    std::unique_ptr<Tree> tree_;
};

}  // namespace terratet
