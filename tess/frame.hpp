// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The frame of a model: coordinate reference system and local origin. Inside, coordinates are local; files carry
/// true ones. The origin is such that going from one to the other and back is exact, so a reloaded model has
/// bit-identical coordinates and hence the same tessellation (CGAL's is unique for a set of doubles).

#include <string>

#include "tess/geometry.hpp"

namespace terratet {

struct Frame {
    std::string crs_wkt;         ///< WKT2 of a projected CRS; empty for a local engineering frame
    std::string crs_name;        ///< for people: "EPSG:3067 ETRS89 / TM35FIN(E,N)"
    std::string unit = "metre";  ///< of all three axes
    double metres_per_unit = 1.0;
    Vec3 origin;  ///< multiples of 1024, or 0

    /// True to local: exact for every coordinate that came from to_world() or through snapped().
    [[nodiscard]] Vec3 to_local(const Vec3& world) const { return world - origin; }
    [[nodiscard]] Vec3 to_world(const Vec3& local) const { return local + origin; }

    /// The nearest local point whose true coordinates are doubles: (O + x) − O. Every computed vertex goes through it.
    [[nodiscard]] Vec3 snapped(const Vec3& local) const { return to_local(to_world(local)); }

    friend bool operator==(const Frame&, const Frame&) = default;
};

/// Origin for an extent in true coordinates: on each axis a multiple of 1024 near the middle, and 0 unless
/// |X − O| ≤ |X| over the whole extent (then the subtraction is exact).
Vec3 choose_origin(const Box3& world_extent);

}  // namespace terratet
