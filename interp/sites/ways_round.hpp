// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The shortest way round barriers from a place to a site: straight to one that is seen, or by way of the barriers'
/// free rims, where such ways turn (tess/barrier/query/rim_turns.hpp). In a metric's coordinates. Found along straight
/// lines between places just outside the rims, it may be somewhat longer than the shortest way there is, never shorter;
/// a sheet that a way would have to bend round between its rims counts as barring it.

#include <functional>
#include <mutex>
#include <utility>
#include <vector>

#include "interp/anisotropy.hpp"
#include "tess/barrier_query.hpp"

namespace terratet {

class WaysRound {
  public:
    /// \param to_site  from a place straight to the nearest site that it sees; infinity where it sees none. Asked at up
    ///                 to 256 places, when first needed.
    WaysRound(const BarrierQuery& barriers, const Metric& metric, std::function<double(const Vec3&)> to_site);

    /// \param straight  to_site(place)
    [[nodiscard]] double shorter(const Vec3& place, double straight) const;

    /// Places where ways turn from which the rest of the way is another than it was, in the metric, and that rest, the
    /// shorter of the two. \pre Barriers and metric are the same.
    [[nodiscard]] std::vector<std::pair<Vec3, double>> changed_since(const WaysRound& before) const;

  private:
    void find() const;

    const BarrierQuery& barriers_;
    Metric metric_;
    std::function<double(const Vec3&)> to_site_;
    mutable std::once_flag wanted_;
    mutable std::vector<Vec3> at_;         ///< the turns, in the metric
    mutable std::vector<double> onwards_;  ///< from each to a site
};

}  // namespace terratet
