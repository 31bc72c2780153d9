// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Coordinate reference systems, by PROJ. Axis order is always x = easting or longitude, y = northing or latitude.
///
/// Heights: a compound or three-dimensional CRS says their unit itself. With a plain projected CRS they are in its
/// unit (US survey feet for a state plane in feet), with a plain geographic one in metres.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

struct Crs {
    std::string wkt;   ///< WKT2:2019; empty: none given
    std::string name;  ///< "EPSG:3067 ETRS89 / TM35FIN(E,N)" or the name alone
    bool geographic = false;
    bool local = false;              ///< an engineering frame, unrelated to the globe
    std::string unit = "metre";      ///< of the horizontal axes: "metre", "US survey foot", "degree", …
    double metres_per_unit = 1.0;    ///< of a projected CRS
    double metres_per_height = 1.0;  ///< unit of heights

    [[nodiscard]] bool empty() const { return wkt.empty(); }
    friend bool operator==(const Crs&, const Crs&) = default;
};

/// From anything PROJ understands: EPSG:3067, a WKT, a PROJJSON, a name. "local" (any case) gives an engineering frame
/// in metres, "local:ft" in feet. Throws UsageError saying what was not understood.
Crs parse_crs(const std::string& text);

/// From a WKT as a file carries it; empty Crs for an empty or unusable one, and for the "Undefined …" that GeoPackages
/// store for unknown.
Crs crs_from_wkt(const std::string& wkt);

/// Where a CRS is meant to be used, in degrees; across the antimeridian when west > east.
struct AreaOfUse {
    double west = 0, south = 0, east = 0, north = 0;
    std::string name;  ///< "New Zealand - onshore"

    /// Within, or beyond by at most a tenth of its size and a degree. False for NaN.
    [[nodiscard]] bool nearly_holds(double longitude_deg, double latitude_deg) const;
};

/// nullopt when it does not say.
std::optional<AreaOfUse> area_of_use(const Crs& crs);

/// The UTM zone (WGS 84, EPSG:326zz or 327zz) of a place, Norway's and Svalbard's exceptions included. Throws
/// InputError beyond 84° N and 80° S, where there is none.
Crs utm_zone(double longitude_deg, double latitude_deg);

/// Transforms coordinates from one CRS to another. Heights change as PROJ does between CRSs that both have them, and
/// else only in unit.
class CrsTransform {
  public:
    /// Throws InputError when PROJ knows no way.
    CrsTransform(const Crs& source, const Crs& target);
    ~CrsTransform();
    CrsTransform(CrsTransform&&) noexcept;
    CrsTransform& operator=(CrsTransform&&) noexcept;

    /// In place; a point that cannot be transformed becomes NaN on all axes. Identity when both CRSs are equal. A NaN
    /// height stays one and the plane coordinates are transformed. Not for two threads at once.
    void apply(std::vector<Vec3>& points) const;
    [[nodiscard]] bool identity() const;

    /// What to say of the accuracy: empty, or that points were transformed with nothing better than a "ballpark" (a
    /// datum grid is missing on this machine; errors of metres to hundreds of metres). Meaningful after apply().
    [[nodiscard]] std::string remark() const;

    /// Direction of the source's north (its +y) at a place, degrees clockwise from the target's grid north: what to add
    /// to an azimuth counted from the one to count it from the other.
    /// \pre `source_point` can be transformed (else NaN).
    [[nodiscard]] double north_deg(const Vec3& source_point) const;

    /// Direction of true north at a place of the target, degrees clockwise from its grid north: what to add to a true
    /// azimuth to get a grid azimuth (the negative of what surveyors call grid convergence). 0 for a local frame.
    [[nodiscard]] double convergence_deg(const Vec3& target_point) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
