// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// By what natural neighbours are weighed: the volume that a place would take of each one's Voronoi cell (Sibson), or
/// the area of the facet it would share with it over their distance (Laplace).

namespace terratet {

enum class Weighting { sibson, laplace };

}  // namespace terratet
