// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Boreholes and desurveying: from collar and survey to positions along the hole.

#include <string>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// One survey station. Angles are degrees; azimuth clockwise from grid north (+y); inclination from the downward
/// vertical (0: straight down, 90: horizontal, 180: straight up).
struct SurveyStation {
    double depth = 0;  ///< measured along the hole
    double azimuth_deg = 0;
    double inclination_deg = 0;

    friend bool operator==(const SurveyStation&, const SurveyStation&) = default;
};

/// How a hole goes from one station to the next.
enum class Desurvey {
    minimum_curvature,    ///< a circular arc tangent to both directions (Sawaryn and Thorogood, SPE 84246)
    tangential,           ///< a straight leg in the upper station's direction ("raw tangent")
    balanced_tangential,  ///< half the way in the upper station's direction, half in the lower one's
};

/// The path of a hole as a chain of arcs (minimum curvature) or straight legs. Its speed is 1: two places a measured
/// depth d apart are joined by a piece of path of length d.
class Trajectory {
  public:
    /// A vertical hole from `collar` when there are no stations. Stations may come in any order and need none at
    /// depth 0: the first one's direction then holds up to the collar, the last one's below it. Of stations at equal
    /// depth the first counts. Between opposite directions (180° apart) the arc's plane is undefined; the leg is
    /// then the balanced tangential one.
    /// \pre All numbers are finite, depths not negative.
    Trajectory(const Vec3& collar, std::vector<SurveyStation> stations, Desurvey method = Desurvey::minimum_curvature);

    /// The path through points that were measured as such, straight from each to the next; above the first and below
    /// the last it goes on straight. Depths along it are those given, whatever the distances between the points.
    /// \pre As many depths as points, at least one; ascending, none twice, the first not negative; all finite.
    Trajectory(std::vector<double> depths, std::vector<Vec3> points);

    /// Position at a measured depth (also between stations: along the arc; below the last: straight on). O(log n).
    [[nodiscard]] Vec3 position(double depth) const;

    /// The depths at which a polyline from the collar to `deepest` needs a point: its ends, the stations between, the
    /// bends of straight legs, and on arcs one for each `max_turn_deg` of turn. Ascending.
    /// \pre deepest ≥ 0, max_turn_deg > 0.
    [[nodiscard]] std::vector<double> polyline_depths(double deepest, double max_turn_deg = 2) const;

    [[nodiscard]] const std::vector<SurveyStation>& stations() const { return stations_; }

  private:
    [[nodiscard]] Vec3 advance(std::size_t station, double distance) const;

    std::vector<SurveyStation> stations_;  ///< ascending, first at depth 0
    std::vector<Vec3> directions_;         ///< unit tangents at the stations
    std::vector<Vec3> positions_;          ///< at the stations
    Desurvey method_;
};

/// A borehole of the model.
struct Borehole {
    std::string id;          ///< text as in the table: "0.0" and "0" differ
    Vec3 collar;             ///< frame-local
    std::vector<Vec3> path;  ///< frame-local, from collar to the deepest record; the collar alone without records
    std::vector<double> path_depth;  ///< measured depth of each path point
};

}  // namespace terratet
