// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The frame of a model: coordinate reference system and local origin. Inside, coordinates are local; files carry
/// true ones. The origin is such that going from one to the other and back is exact, so a reloaded model has
/// bit-identical coordinates and hence the same tessellation (CGAL's is unique for a set of doubles).
///
/// Flat sites (50 km × 50 km × 200 m) are tessellated in stretched z: local z is z_scale times the true distance from
/// the origin, so every length, angle and volume inside is that of the stretched ground. Only this class knows.

#include <string>

#include "tess/geometry.hpp"

namespace terratet {

struct Frame {
    std::string crs_wkt;         ///< WKT2 of a projected CRS; empty for a local engineering frame
    std::string crs_name;        ///< for people: "EPSG:3067 ETRS89 / TM35FIN(E,N)"
    std::string unit = "metre";  ///< of all three axes
    double metres_per_unit = 1.0;
    Vec3 origin;         ///< multiples of 1024, or 0
    double z_scale = 1;  ///< local z over true z

    [[nodiscard]] Vec3 to_local(const Vec3& world) const {
        const Vec3 d = world - origin;
        return {d.x, d.y, z_scale * d.z};
    }

    /// The true coordinates; for a snapped point those that to_local() brings back to the very same doubles.
    [[nodiscard]] Vec3 to_world(const Vec3& local) const {
        return {local.x + origin.x, local.y + origin.y, z_scale == 1 ? local.z + origin.z : world_z(local.z)};
    }

    /// A true size along the axes as a local one, and back.
    [[nodiscard]] Vec3 to_local_size(const Vec3& size) const { return {size.x, size.y, size.z * z_scale}; }
    [[nodiscard]] Vec3 to_world_size(const Vec3& size) const { return {size.x, size.y, size.z / z_scale}; }

    /// The nearest local point whose true coordinates are doubles: (O + x) − O. Every computed vertex goes through it.
    [[nodiscard]] Vec3 snapped(const Vec3& local) const { return to_local(to_world(local)); }

    friend bool operator==(const Frame&, const Frame&) = default;

  private:
    [[nodiscard]] double world_z(double local) const;
};

/// Origin for an extent in true coordinates: on each axis a multiple of 1024 near the middle, and 0 unless
/// |X − O| ≤ |X| over the whole extent (then the subtraction is exact).
Vec3 choose_origin(const Box3& world_extent);

}  // namespace terratet
