// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// From the model's frame to the scene's: metres from an origin near the middle of the extent, y up (east, up, −north).

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tess/model.hpp"

namespace terratet {

/// Where on the globe the scene's origin is.
struct GlobePlace {
    double longitude_deg = 0;
    double latitude_deg = 0;
    double height = 0;                     ///< metres above the ellipsoid of WGS 84, as far as PROJ knows
    std::array<double, 16> enu_to_ecef{};  ///< of (east, north, up) in metres, column-major
    double convergence_deg = 0;            ///< grid north, clockwise from true north
};

class SceneFrame {
  public:
    enum class Axes {
        grid,  ///< offsets in the model's CRS: east and north are the grid's
        enu,   ///< east, north and up on the globe at the origin, through earth-centred coordinates: convergence,
               ///< scale and curvature are in the positions
    };
    /// The origin is on a round number, where single precision is finest. \param vertical_crs  EPSG code of the
    /// heights, for a system that says none (io/base/vertical_crs.hpp); may be empty. Throws UsageError for enu in a
    /// model without a place on the globe.
    explicit SceneFrame(const Model& model, Axes axes = Axes::grid, const std::string& vertical_crs = {});
    ~SceneFrame();
    SceneFrame(SceneFrame&&) noexcept;

    [[nodiscard]] Vec3 position(const Vec3& local) const;
    [[nodiscard]] std::vector<Vec3> positions(const std::vector<Vec3>& local) const;
    /// Longitude and latitude in degrees and height of true coordinates; empty where globe() is none.
    [[nodiscard]] std::vector<Vec3> places_on_globe(std::vector<Vec3> world) const;
    [[nodiscard]] const Vec3& origin() const { return origin_; }  ///< in true coordinates
    [[nodiscard]] double metres_per_unit() const;
    [[nodiscard]] Axes axes() const { return axes_; }
    /// None in a local engineering frame, or where PROJ knows no way.
    [[nodiscard]] const std::optional<GlobePlace>& globe() const { return globe_; }

  private:
    struct Globe;  ///< the transformation

    const Frame* frame_;
    Axes axes_;
    Vec3 origin_;
    Vec3 local_origin_;
    std::unique_ptr<Globe> to_globe_;
    std::optional<GlobePlace> globe_;
};

}  // namespace terratet
