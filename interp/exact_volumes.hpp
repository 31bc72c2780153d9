// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The stolen volumes of a cavity in rational numbers: what to fall back to when doubles do not suffice.

#include <vector>

#include "interp/cavity.hpp"

namespace terratet {

/// The share of each of the cavity's vertices in the query's Voronoi cell, exact up to the last rounding. Milliseconds.
void exact_shares(const CompactDelaunay& mesh, const Cavity& cavity, const Vec3& q, std::vector<double>& shares);

}  // namespace terratet
