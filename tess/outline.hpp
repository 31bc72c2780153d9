// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What bounds a model in plan: the outline of its domain polygon, and the upright walls over it, which are prepared
/// and seeded as faults are. Everything here is in plan: z does not count.

#include <vector>

#include "tess/geometry.hpp"
#include "tess/surface.hpp"

namespace terratet {

/// Closed rings, the first point not repeated; the inside is on their left. z is 0.
using Rings = std::vector<std::vector<Vec3>>;

struct OutlineReport {
    std::size_t corners_in = 0;  ///< of the polygon as read
    std::size_t corners = 0;     ///< left of them
    std::size_t dropped = 0;     ///< rings too small to show
    double area_in = 0;
    double area = 0;
    double deviation = 0;  ///< of a corner as read from the outline, at most; dropped rings do not count
};

/// The outline of the surfaces of kind domain, drawn to a spacing: corners that stand out by less than a tenth of it go
/// (topology-preserving: Dyken, Dæhlen and Sevaldrud 2009), then those that make edges shorter than 0.7 of it, and
/// rings with less area than its square. No rings without such surfaces. Depends on the order of neither triangles nor
/// surfaces. O(n log n), quadratic in what is left.
Rings outline_of(const std::vector<Surface>& surfaces, double spacing, OutlineReport& report);

/// Positive: holes turn the other way.
double area(const Rings& rings);

/// Box in plan; z is 0. Empty without rings.
Box3 bounding_box(const Rings& rings);

/// The part of an edge of a ring that lies within a box in plan and not along its faces, as a length.
double length_inside(const Vec3& a, const Vec3& b, const Box3& box);

/// Upright rectangles over the edges, their normals outwards, from `reach` below to `reach` above the extent. Edges
/// that lie beyond the extent or along one of its faces have none. Neighbours belong to different surfaces, so that
/// each corner is a junction and stays where it is; two or three surfaces are enough.
std::vector<Surface> domain_walls(const Rings& outline, const std::string& name, const std::string& file,
                                  const Box3& extent, double reach);

/// Is a place inside? Constant time mostly. Without rings every place is.
class Outline {
  public:
    explicit Outline(const Rings& rings);

    [[nodiscard]] bool contains(const Vec3& p) const;

  private:
    struct Edge {
        Vec3 a, b;
    };
    [[nodiscard]] std::size_t strip(double y) const;

    Box3 box_;
    double height_ = 1;                      ///< of a strip
    std::vector<std::vector<Edge>> strips_;  ///< by y: the edges that come into it
};

}  // namespace terratet
