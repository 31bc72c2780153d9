// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Triangulated surfaces as they come from files: faults, horizons, topography, the domain.

#include <span>
#include <string>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// All kinds part regions. A fault bars estimation as well, a horizon that of some properties; topography has nothing
/// above. A domain as read is a polygon in plan, triangulated; prepared it is the walls over the polygon's edges
/// (tess/outline.hpp), with nothing beyond.
enum class SurfaceKind { fault, horizon, topography, domain };

/// "fault", "horizon", "topography", "domain".
const char* to_string(SurfaceKind kind);

/// Does the model end at surfaces of this kind? Their normals point out of it.
constexpr bool is_bound(SurfaceKind kind) {
    return kind == SurfaceKind::topography || kind == SurfaceKind::domain;
}

struct Surface {
    std::string name;
    SurfaceKind kind = SurfaceKind::fault;
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::string file;  ///< where it came from, for messages

    friend bool operator==(const Surface&, const Surface&) = default;
};

/// The one order of surfaces: by name, then by area, then by corners and triangles as they are given, then by kind and
/// file. So where a file lies does not matter, nor, but for equal areas, the order of what is in it. O(1) for different
/// names, else O(n).
bool canonical_before(const Surface& a, const Surface& b);

struct SurfaceStatistics {
    double area = 0;
    double dip_mean_deg = 0;       ///< area-weighted mean of the triangles' dips, 0 horizontal … 90 vertical
    double dip_direction_deg = 0;  ///< of the mean upward normal's downslope, clockwise from +y; 0 when undefined
    double dip_min_deg = 0;
    double dip_max_deg = 0;
};

/// Triangles without area count for nothing. O(n).
SurfaceStatistics statistics(const Surface& surface);

/// Triangulates a cloud of points in its best-fit plane (2D Delaunay of the projections), the input the paper uses for
/// its fracture. Triangles whose longest edge exceeds `max_edge_factor` × the median edge are left out, so that a
/// non-convex outline is not bridged; 0 keeps all. Triangles on the hull that are flat to rounding (points on one line,
/// off it in the last bits) are always left out. Fewer than three points, or collinear ones, give no triangles.
///
/// The result does not depend on the order of the points: vertices are sorted and each position occurs once; triangles
/// start with their smallest vertex, are sorted, and turn their normals to one side of the plane: up, for a vertical
/// plane to +y, and to +x for one across y. Of points that project to the same place only the first becomes a vertex.
/// O(n log n). \pre Points are finite.
Surface triangulate_in_best_fit_plane(std::string name, std::vector<Vec3> points, double max_edge_factor = 0);

/// Triangulates a polygon, its outer ring first and then its holes, in its best-fit plane (constrained 2D Delaunay).
/// Rings are open: the first point is not repeated. Indices count through all rings in order; the triangles turn as the
/// outer ring does. No triangles when the projected rings cross or touch each other or have no area. O(n log n). \pre
/// Points are finite.
std::vector<Triangle> triangulate_polygon(std::span<const std::vector<Vec3>> rings);

}  // namespace terratet
