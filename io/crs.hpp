// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Coordinate reference systems, by PROJ. Axis order is always x = easting or longitude, y = northing or latitude.

#include <memory>
#include <string>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

struct Crs {
    std::string wkt;               ///< WKT2:2019; empty: none given
    std::string name;              ///< "EPSG:3067 ETRS89 / TM35FIN(E,N)" or the name alone
    bool geographic = false;
    std::string unit = "metre";    ///< of the horizontal axes: "metre", "US survey foot", "degree", …
    double metres_per_unit = 1.0;  ///< of a projected CRS

    [[nodiscard]] bool empty() const { return wkt.empty(); }
};

/// From anything PROJ understands: EPSG:3067, a WKT, a PROJJSON, a name. "local" (any case) gives an engineering frame
/// in metres, "local:ft" in feet. Throws UsageError saying what was not understood.
Crs parse_crs(const std::string& text);

/// From a WKT as a file carries it; empty Crs for an empty or unusable one.
Crs crs_from_wkt(const std::string& wkt);

/// The UTM zone (WGS 84, EPSG:326zz or 327zz) of a place, Norway's and Svalbard's exceptions included.
Crs utm_zone(double longitude_deg, double latitude_deg);

/// Transforms coordinates from one CRS to another, heights as PROJ does (unchanged between 2D CRSs, but for the unit of
/// height, which is `metres_per_unit` of each side's CRS when both are projected).
class CrsTransform {
  public:
    /// Throws InputError when PROJ knows no way.
    CrsTransform(const Crs& source, const Crs& target);
    ~CrsTransform();
    CrsTransform(CrsTransform&&) noexcept;
    CrsTransform& operator=(CrsTransform&&) noexcept;

    /// In place; a point that cannot be transformed becomes NaN on all axes. Identity when both CRSs are equal.
    void apply(std::vector<Vec3>& points) const;
    [[nodiscard]] bool identity() const;

    /// Grid convergence at a place of the target in degrees, clockwise from grid north to true north: what to subtract…
    /// see --azimuth. 0 for a local frame.
    [[nodiscard]] double convergence_deg(const Vec3& target_point) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
