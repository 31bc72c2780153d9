// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Shares in wider floats and in rational numbers: what to fall back to when doubles do not suffice.

#include <array>
#include <vector>

#include "interp/cavity.hpp"
#include "interp/natural_neighbour.hpp"

namespace terratet {

/// The share of each of the cavity's vertices in floats of 113 bits; false, and no shares, where even those break
/// Sibson's identity: |Σ wᵢpᵢ − q| above 1e-15 distances to the nearest site, or a weight below −1e-15. Half a
/// microsecond a cell and facet.
bool wide_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q,
                 NaturalNeighbourOptions::Weighting weighting, std::vector<double>& shares);

/// The share of each of the cavity's vertices, exact up to the last rounding. Milliseconds, and among dense boreholes
/// tenths of a second.
void exact_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q,
                  NaturalNeighbourOptions::Weighting weighting, std::vector<double>& shares);

/// The barycentric coordinates of q in a cell, to the last rounding.
std::array<double, 4> exact_barycentric(const std::array<Vec3, 4>& corners, const Vec3& q);

}  // namespace terratet
