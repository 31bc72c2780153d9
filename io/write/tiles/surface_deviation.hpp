// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How far a simplified surface is from the full one, measured.

#include "io/write/tiles/simplify_surface.hpp"

namespace terratet {

struct Deviation {
    double distance = 0;  ///< the largest, in the unit of places
    double color = 0;     ///< the largest difference of one channel, 0 to 1

    void extend(const Deviation& other);
    /// What a viewer should take it for.
    [[nodiscard]] double metres(double color_metres) const;
};

/// From each corner and middle of the full surface's triangles to the nearest place of the coarse one, and back from
/// the middles of the coarse one's; of equally near places to the one most alike in colour, since a fault's two sides
/// may coincide. O(n log n).
Deviation surface_deviation(const SurfaceLook& look, std::span<const Triangle> full, std::span<const Triangle> coarse);

}  // namespace terratet
