// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The sites that refinement is measured on.

#include <optional>
#include <string>

#include "peer.hpp"
#include "tess/build.hpp"

namespace terratet::bench {

struct RefinementSite {
    std::string name;
    Site site;
    BuildOptions options;  ///< extent, l_min and l_max; the rest as it is by default
};

/// The paper's experiment: 4 holes, 1 292 samples, a fracture of 465 points; 20 m to 80 m.
RefinementSite twin();

/// 200 wells × 50 samples in the twin's box, 5 planar faults; 15 m to 60 m.
RefinementSite made_up();

/// 399 holes in feet, 23 690 samples, and a dipping fault; l_min, in feet, to 4 l_min. Nothing where the public data
/// are absent.
std::optional<RefinementSite> babbitt(double l_min);

/// A site as other generators can take it: samples and the faults' vertices, thinned to l_min, in the extent.
PointsInBox bare_points(const RefinementSite& site);

}  // namespace terratet::bench
