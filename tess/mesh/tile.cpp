// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mesh/tile.hpp"

#include <CGAL/Interval_nt.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "tess/base/poll.hpp"
#include "tess/mesh/bulk_insertion.hpp"
#include "tess/mesh/delaunay.hpp"

namespace terratet {
namespace {

using delaunay::Cell;
using delaunay::Triangulation;
using Interval = CGAL::Interval_nt<false>;

Box3 grown(const Box3& box, double by, const Box3& within) {
    Box3 out;
    for (int axis = 0; axis < 3; ++axis) {
        out.lo[axis] = std::max(box.lo[axis] - by, within.lo[axis]);
        out.hi[axis] = std::min(box.hi[axis] + by, within.hi[axis]);
    }
    return out;
}

Box3 box_of(Cell cell) {
    Box3 box;
    for (int k = 0; k < 4; ++k) {
        box.extend(delaunay::from_cgal(cell->vertex(k)->point()));
    }
    return box;
}

bool meet(const Box3& a, const Box3& b) {
    for (int axis = 0; axis < 3; ++axis) {
        if (a.lo[axis] > b.hi[axis] || a.hi[axis] < b.lo[axis]) {
            return false;
        }
    }
    return true;
}

/// Is the box farther away than the square root?
bool surely_farther(const Box3& box, const std::array<Interval, 3>& from, const Interval& square) {
    Interval distance(0);
    for (int axis = 0; axis < 3; ++axis) {
        const Interval& x = from[static_cast<std::size_t>(axis)];
        const Interval short_of = Interval(box.lo[axis]) - x;
        const Interval beyond = x - Interval(box.hi[axis]);
        if (short_of.inf() > 0) {
            distance += CGAL::square(short_of);
        } else if (beyond.inf() > 0) {
            distance += CGAL::square(beyond);
        }
    }
    return distance.inf() > square.sup();
}

/// Is what the closed circumball has of the hull surely within the box? CGAL's rounding is upwards here.
bool certified(Cell cell, const Box3& box, const Box3& hull) {
    const Vec3 o = delaunay::from_cgal(cell->vertex(0)->point());
    std::array<std::array<Interval, 3>, 3> edge;
    std::array<Interval, 3> square;
    for (int k = 0; k < 3; ++k) {
        const Vec3 p = delaunay::from_cgal(cell->vertex(k + 1)->point());
        auto& e = edge[static_cast<std::size_t>(k)];
        for (int axis = 0; axis < 3; ++axis) {
            e[static_cast<std::size_t>(axis)] = Interval(p[axis]) - Interval(o[axis]);
        }
        square[static_cast<std::size_t>(k)] = CGAL::square(e[0]) + CGAL::square(e[1]) + CGAL::square(e[2]);
    }
    const auto cross = [](const auto& a, const auto& b, std::size_t axis) {
        return a[(axis + 1) % 3] * b[(axis + 2) % 3] - a[(axis + 2) % 3] * b[(axis + 1) % 3];
    };
    Interval determinant(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        determinant += edge[0][axis] * cross(edge[1], edge[2], axis);
    }
    if (determinant.inf() <= 0 && determinant.sup() >= 0) {
        return false;
    }
    std::array<Interval, 3> center;  // from the first corner
    for (std::size_t axis = 0; axis < 3; ++axis) {
        center[axis] = (square[0] * cross(edge[1], edge[2], axis) + square[1] * cross(edge[2], edge[0], axis) +
                        square[2] * cross(edge[0], edge[1], axis)) /
                       (Interval(2) * determinant);
    }
    const Interval square_radius = CGAL::square(center[0]) + CGAL::square(center[1]) + CGAL::square(center[2]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        center[axis] += Interval(o[static_cast<int>(axis)]);
    }
    for (int axis = 0; axis < 3; ++axis) {  // parts of the hull that were not read
        Box3 below = hull;
        Box3 above = hull;
        below.hi[axis] = box.lo[axis];
        above.lo[axis] = box.hi[axis];
        if ((box.lo[axis] > hull.lo[axis] && !surely_farther(below, center, square_radius)) ||
            (box.hi[axis] < hull.hi[axis] && !surely_farther(above, center, square_radius))) {
            return false;
        }
    }
    return true;
}

/// Does the vertices' convex hull hold the tile? Exact.
bool hull_holds(const Triangulation& triangulation, const Box3& tile) {
    std::array<delaunay::Point, 8> corners;
    for (std::size_t n = 0; n < 8; ++n) {
        corners[n] = {(n & 1U) != 0 ? tile.hi.x : tile.lo.x, (n & 2U) != 0 ? tile.hi.y : tile.lo.y,
                      (n & 4U) != 0 ? tile.hi.z : tile.lo.z};
    }
    std::vector<Cell> beyond;
    triangulation.incident_cells(triangulation.infinite_vertex(), std::back_inserter(beyond));
    return std::ranges::all_of(beyond, [&](Cell cell) {
        const int infinite = cell->index(triangulation.infinite_vertex());
        return std::ranges::all_of(corners, [&](const delaunay::Point& corner) {
            std::array<delaunay::Point, 4> points;
            for (int k = 0; k < 4; ++k) {
                points[static_cast<std::size_t>(k)] = k == infinite ? corner : cell->vertex(k)->point();
            }
            return CGAL::orientation(points[0], points[1], points[2], points[3]) != CGAL::POSITIVE;
        });
    });
}

/// False when more has to be read.
bool collect(const Triangulation& triangulation, const Box3& tile, const Box3& hull, Tile& out) {
    const bool all_read = out.read.lo == hull.lo && out.read.hi == hull.hi;
    assert(!all_read || hull_holds(triangulation, tile));
    if (!all_read && (triangulation.dimension() < 3 || !hull_holds(triangulation, tile))) {
        return false;
    }
    const Interval::Protector rounding;
    for (auto cell = triangulation.finite_cells_begin(); cell != triangulation.finite_cells_end(); ++cell) {
        if (!meet(box_of(cell), tile)) {
            continue;
        }
        if (!all_read && !certified(cell, out.read, hull)) {
            return false;
        }
        auto& corners = out.mesh.cells.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) {
            corners[k] = cell->vertex(static_cast<int>(k))->info();
        }
    }
    return true;
}

/// As a whole mesh has them: the smallest corner first, positive, in order.
void put_in_order(TetMesh& mesh) {
    for (auto& corners : mesh.cells) {
        const auto first = static_cast<std::size_t>(std::ranges::min_element(corners) - corners.begin());
        if (first != 0) {  // two exchanges keep the orientation
            std::swap(corners[0], corners[first]);
            std::swap(corners[first == 1 ? 2 : 1], corners[first == 3 ? 2 : 3]);
        }
        while (corners[1] > corners[2] || corners[1] > corners[3]) {
            std::rotate(corners.begin() + 1, corners.begin() + 2, corners.end());
        }
    }
    std::ranges::sort(mesh.cells);
}

}  // namespace

Tile tessellate_tile(const Box3& tile, const Box3& hull, double halo, const VerticesIn& vertices_in, const Poll& poll) {
    assert(halo > 0);
    for (int round = 0;; ++round, halo *= 2) {
        Tile out{{}, {}, grown(tile, halo, hull), round};
        out.vertices = vertices_in(out.read);
        std::vector<std::pair<delaunay::Point, std::uint32_t>> points;
        points.reserve(out.vertices.size());
        for (const Vertex& vertex : out.vertices) {
            points.emplace_back(delaunay::to_cgal(vertex.position), static_cast<std::uint32_t>(points.size()));
        }
        Triangulation triangulation;
        PatientPoll go_on(poll);
        delaunay::insert(triangulation, points, go_on);
        if (collect(triangulation, tile, hull, out)) {
            for (const Vertex& vertex : out.vertices) {
                out.mesh.points.push_back(vertex.position);
            }
            put_in_order(out.mesh);
            return out;
        }
    }
}

}  // namespace terratet
