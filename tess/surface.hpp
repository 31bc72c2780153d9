// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Triangulated surfaces as they come from files: faults, horizons, topography.

#include <string>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

enum class SurfaceKind { fault, horizon, topography };

struct Surface {
    std::string name;
    SurfaceKind kind = SurfaceKind::fault;
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::string file;  ///< where it came from, for messages

    friend bool operator==(const Surface&, const Surface&) = default;
};

struct SurfaceStatistics {
    double area = 0;
    double dip_mean_deg = 0;            ///< area-weighted mean of the triangles' dips, 0 horizontal … 90 vertical
    double dip_direction_deg = 0;       ///< of the mean upward normal's downslope, clockwise from +y; 0 when undefined
    double dip_min_deg = 0;
    double dip_max_deg = 0;
};

SurfaceStatistics statistics(const Surface& surface);

/// Triangulates a cloud of points in its best-fit plane (2D Delaunay of the projections), the input the paper uses for
/// its fracture. Triangles whose longest edge exceeds `max_edge_factor` × the median edge are left out, so that a
/// non-convex outline is not bridged; 0 keeps all. Fewer than three points, or collinear ones, give no triangles.
/// O(n log n).
Surface triangulate_in_best_fit_plane(std::string name, std::vector<Vec3> points, double max_edge_factor = 0);

}  // namespace terratet
