// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Fewer triangles for a surface seen from afar, whose colours count as its shape does: a section is flat, and what it
/// shows are its colours. Edges are contracted by the quadrics of M. Garland and P. Heckbert, "Simplifying surfaces
/// with color and texture using quadric error metrics" (1998), in six dimensions: three of place, three of colour.

#include <cstddef>
#include <span>
#include <vector>

#include "io/style/color_map.hpp"
#include "tess/geometry.hpp"

namespace terratet {

/// What is to look the same.
struct SurfaceLook {
    std::span<const Vec3> places;
    std::span<const Color> colors;  ///< in step with places, or none: one colour throughout
    double color_metres = 1;        ///< how far a place may go for a colour from one end of a channel to the other
};

/// Contracts edges towards one of their ends until no more than so many triangles are left, or none can be contracted.
/// Corners are given places. What lies on an edge that has not two triangles stays, so that borders, also those between
/// pieces of one surface, are the same before and after; no triangle turns over. O(n log n).
std::vector<Triangle> simplify_surface(const SurfaceLook& look, std::vector<Triangle> triangles, std::size_t most);

}  // namespace terratet
