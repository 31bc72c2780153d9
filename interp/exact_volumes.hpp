// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Shares in rational numbers: what to fall back to when doubles do not suffice.

#include <array>
#include <vector>

#include "interp/cavity.hpp"
#include "interp/natural_neighbour.hpp"

namespace terratet {

/// The share of each of the cavity's vertices, exact up to the last rounding. Milliseconds.
void exact_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q,
                  NaturalNeighbourOptions::Weighting weighting, std::vector<double>& shares);

/// The barycentric coordinates of q in a cell, to the last rounding.
std::array<double, 4> exact_barycentric(const std::array<Vec3, 4>& corners, const Vec3& q);

}  // namespace terratet
