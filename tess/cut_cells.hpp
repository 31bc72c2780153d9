// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where the cells of a mesh are met by a plane, or by a level of a field that is linear in each of them: sections and
/// isosurfaces, exactly as the cells have them (marching tetrahedra, without a lattice). As the vertices on both sides
/// of a fault are different ones, a cut ends at the fault on both sides.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tess/geometry.hpp"
#include "tess/property.hpp"

namespace terratet {

/// The points with normal · p = offset.
struct CutPlane {
    Vec3 normal;
    double offset = 0;

    /// Through a point.
    static CutPlane through(const Vec3& point, const Vec3& normal) { return {normal, dot(normal, point)}; }
    [[nodiscard]] double distance(const Vec3& p) const { return dot(normal, p) - offset; }
};

/// Triangles that share corners. Each looks to where the level rises.
struct CellCut {
    /// On the edge from point a to point b of the mesh, at the fraction t of it; a = b and t = 0 at a point itself.
    struct Corner {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
        double t = 0;
    };
    std::vector<Corner> corners;
    std::vector<Triangle> triangles;  ///< of corners; those of one cell one after the other, a convex polygon
    std::vector<std::uint32_t> cell;  ///< of each triangle

    [[nodiscard]] std::vector<Vec3> positions(std::span<const Vec3> points) const;
    /// Linear along the edge.
    [[nodiscard]] std::vector<double> mixed(std::span<const double> values) const;
    /// A property's measured values: linear in its scale; of a category the nearer end's.
    [[nodiscard]] std::vector<double> values(const Property& property, std::span<const double> measured) const;
};

using CellCorners = std::array<std::uint32_t, 4>;

/// Where a level, given at the points, takes the value `at`. What is at it counts as above, so that a facet in the cut
/// appears once: with the cell below it. Cells with a level that is NaN are left out, as are those that `left_out` (one
/// flag a cell, or empty) says. O(cells).
CellCut cut_cells(std::span<const CellCorners> cells, std::span<const double> level, double at,
                  std::span<const std::uint8_t> left_out = {});

/// Where a plane meets them; triangles look along its normal.
CellCut cut_cells(std::span<const Vec3> points, std::span<const CellCorners> cells, const CutPlane& plane,
                  std::span<const std::uint8_t> left_out = {});

/// The share of a tetrahedron's volume in which a level, linear between the four corners, is at or above `at`: exact
/// but for rounding. NaN where a level is.
double share_above(const std::array<double, 4>& level, double at);

}  // namespace terratet
