// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// All sheets of all faults as one complex of triangles. Sheets that meet share points and edges, so that a
/// junction is conforming by construction; an edge may have any number of triangles.

#include <cstdint>
#include <span>
#include <vector>

#include "tess/base/tri_mesh.hpp"

namespace terratet {

struct SheetComplex {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;   ///< of one sheet all in the same sense
    std::vector<std::uint32_t> sheet;  ///< of each triangle: the surface it belongs to, in the caller's numbering

    friend bool operator==(const SheetComplex&, const SheetComplex&) = default;
};

TriangleCorners corners(const SheetComplex& complex, std::uint32_t triangle);

/// Drops points without a triangle; the others keep their order.
void compact(SheetComplex& complex);

/// The triangles of one sheet, with the points they use.
TriMesh sheet_of(const SheetComplex& complex, std::uint32_t sheet);

/// Edges with their triangles, ascending by (a, b), a < b. One triangle: rim; two of one sheet: smooth; else junction.
class EdgeTable {
  public:
    struct Edge {
        std::uint32_t a = 0;
        std::uint32_t b = 0;
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
    };

    explicit EdgeTable(std::span<const Triangle> triangles);

    [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }

    /// Ascending.
    [[nodiscard]] std::span<const std::uint32_t> triangles(const Edge& e) const {
        return {triangles_.data() + e.begin, e.end - e.begin};
    }

    /// None for a pair of points that is no edge. O(log n).
    [[nodiscard]] std::span<const std::uint32_t> triangles(std::uint32_t a, std::uint32_t b) const;

  private:
    std::vector<Edge> edges_;
    std::vector<std::uint32_t> triangles_;
};

/// Two triangles, both of one sheet.
bool is_smooth(const SheetComplex& complex, std::span<const std::uint32_t> of_edge);

/// Patches: triangles connected over smooth edges, numbered by their first triangle.
struct Patches {
    std::vector<std::uint32_t> of_triangle;
    std::uint32_t count = 0;
};
Patches patches(const SheetComplex& complex, const EdgeTable& edges);

/// Turns triangles so that those of one sheet that share an edge with no third one of it have the same sense again:
/// that of the larger area, piece by piece.
void restore_sense(SheetComplex& complex);

/// Halves the edges in which two triangles of different marked sheets meet and nothing else does: corners.
void halve_corners(SheetComplex& complex, const std::vector<char>& marked);

/// The angles between neighbouring triangles round an edge, in radians, in the order of their directions; a rim has
/// none.
struct Fan {
    std::vector<std::uint32_t> triangles;  ///< in turning order about the edge from a to b
    std::vector<double> angle;             ///< from triangles[k] to the next one round; their sum is 2π
};
Fan fan_about(const SheetComplex& complex, std::span<const std::uint32_t> of_edge, std::uint32_t a, std::uint32_t b);

/// The smallest angle round an edge, π for a rim.
double wedge_angle(const SheetComplex& complex, std::span<const std::uint32_t> of_edge, std::uint32_t a,
                   std::uint32_t b);

/// Pairs of triangles that share more than they should: a point of one inside the other that is no common corner or
/// edge. Exact predicates. Ascending pairs. O(n log n).
std::vector<std::array<std::uint32_t, 2>> crossing_triangles(const SheetComplex& complex);

}  // namespace terratet
