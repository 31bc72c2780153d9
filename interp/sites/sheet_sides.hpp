// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// On which sides of the barriers the sites of a tessellation lie, each sheet thought to go on beyond its rims. Asked
/// for where a site sees past a fault's end what lies behind the fault: that tells nothing of a slope on this side.

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "interp/sites/site_mesh.hpp"

namespace terratet {

class SheetSides {
  public:
    /// \param sites  must outlive this. A byte for each site and barrier.
    explicit SheetSides(const SiteMesh& sites);

    /// Squared distances from a site to the barriers. O(barriers · log n).
    void squared_distances(std::int32_t site, std::vector<double>& out) const;

    /// Are the two on different sides of a sheet that is nearer to the first one than the second is?
    /// \param distances  the first one's, by squared_distances(). Sides are found once a site: const and reentrant.
    [[nodiscard]] bool part(std::int32_t site, std::int32_t other, std::span<const double> distances) const;

  private:
    [[nodiscard]] int side(std::size_t barrier, std::int32_t site) const;

    const SiteMesh& sites_;
    std::vector<std::int32_t> barriers_;                       ///< which of the faults
    std::unique_ptr<std::atomic<std::int8_t>[]> known_sides_;  ///< of each site, by barrier; 0: not known yet
};

}  // namespace terratet
