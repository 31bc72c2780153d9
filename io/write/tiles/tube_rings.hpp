// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Boreholes from afar: tubes with fewer rings.

#include <cstdint>
#include <span>
#include <vector>

#include "io/write/scene/scene.hpp"
#include "io/write/tiles/surface_deviation.hpp"

namespace terratet {

/// How far from what its neighbours give a ring is, in metres of place and colour, after D. Douglas and T. Peucker
/// (1973): rings of the tube that weigh more than t are within t of all others. The two at each end weigh infinitely.
/// \pre part.sides > 0
std::vector<double> ring_weights(const ScenePart& part, double color_metres);

/// Of the tube through those rings, from the whole one.
Deviation tube_deviation(const ScenePart& part, std::span<const std::uint32_t> rings, double color_metres);

/// The tube through those rings.
std::vector<Triangle> tube_triangles(const ScenePart& part, std::span<const std::uint32_t> rings);

}  // namespace terratet
