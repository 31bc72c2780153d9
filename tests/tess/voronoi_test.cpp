// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include <voro++/voro++.hh>

#include "support.hpp"
#include "tess/tessellation.hpp"
#include "tess/voronoi/clip_complex.hpp"
#include "tess/voronoi/voronoi_dual.hpp"
#include "tess/voronoi/voronoi_measures.hpp"

using namespace terratet;
using terratet::testing::Random;

namespace {

TetMesh mesh_of(const std::vector<Vec3>& points) {
    std::vector<Vertex> vertices;
    for (const Vec3& p : points) {
        vertices.push_back({vertices.size(), p, Role::inserted, -1, 0});
    }
    Tessellation tessellation;
    tessellation.insert(vertices);
    return tessellation.mesh();
}

void add_corners(const Box3& box, std::vector<Vec3>& points) {
    const Vec3 side = box.size();
    for (int corner = 0; corner < 8; ++corner) {
        points.push_back(box.lo + Vec3{corner & 1 ? side.x : 0, corner & 2 ? side.y : 0, corner & 4 ? side.z : 0});
    }
}

struct Diagram {
    VoronoiComplex complex;
    VoronoiMeasures measures;

    Diagram(const std::vector<Vec3>& points, const Box3& box)
        : complex(clipped_to(voronoi_dual(mesh_of(points)), box)),
          measures(measure(complex, complex.points, points.size())) {}

    [[nodiscard]] double volume() const {
        double sum = 0;
        for (const double v : measures.volume) {
            sum += v;
        }
        return sum;
    }
    /// The largest distance by which a corner is nearer to a third vertex than to its wall's own.
    [[nodiscard]] double worst_corner(const std::vector<Vec3>& points) const {
        double worst = 0;
        for (const VoronoiWall& wall : complex.walls) {
            for (const std::uint32_t corner : complex.polygon(wall)) {
                const Vec3& p = complex.points[corner];
                const double own = distance(p, points[wall.cell]);
                if (wall.beyond >= 0) {
                    worst = std::max(worst, std::abs(own - distance(p, points[static_cast<std::size_t>(wall.beyond)])));
                }
                for (const Vec3& other : points) {
                    worst = std::max(worst, own - distance(p, other));
                }
            }
        }
        return worst;
    }
    /// Each edge of a cell is passed once in either direction.
    [[nodiscard]] bool closed(std::size_t cells) const {
        const WallsOfCells walls = walls_of_cells(complex, cells);
        for (std::size_t cell = 0; cell < cells; ++cell) {
            std::map<std::pair<std::uint32_t, std::uint32_t>, int> passed;
            for (const std::uint32_t w : walls.of(cell)) {
                const auto polygon = complex.polygon(complex.walls[w]);
                for (std::size_t i = 0; i < polygon.size(); ++i) {
                    std::pair edge(polygon[i], polygon[(i + 1) % polygon.size()]);
                    if (complex.walls[w].cell != cell) {
                        std::swap(edge.first, edge.second);
                    }
                    ++passed[edge];
                }
            }
            for (const auto& [edge, times] : passed) {
                if (times != 1 || !passed.contains({edge.second, edge.first})) {
                    return false;
                }
            }
        }
        return true;
    }
};

}  // namespace

TEST_CASE("Voronoi cells are what is nearest to a point, closed, and fill the box") {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        Random random(seed);
        const Box3 hull{{-10, -20, -5}, {110, 120, 60}};
        // The points' own box, one within, and one that reaches beyond them all.
        for (const Box3& box : {hull, Box3{{0, 0, 0}, {100, 90, 40}}, hull.grown(30)}) {
            std::vector<Vec3> points;
            add_corners(hull, points);
            for (int i = 0; i < 300; ++i) {
                points.push_back(random.in(hull));
            }
            const Diagram diagram(points, box);
            CHECK(std::abs(diagram.volume() / box.volume() - 1) < 1e-12);
            CHECK(std::ranges::all_of(diagram.measures.volume, [](double v) { return v >= 0; }));
            CHECK(diagram.worst_corner(points) < 1e-9);
            CHECK(diagram.closed(points.size()));
        }
    }
}

TEST_CASE("The cells of a lattice are boxes, wherever it is cut") {
    std::vector<Vec3> points;
    for (int i = 0; i < 7; ++i) {
        for (int j = 0; j < 6; ++j) {
            for (int k = 0; k < 5; ++k) {
                points.push_back({2.0 * i, 2.0 * j, 2.0 * k});
            }
        }
    }
    for (const Box3& box : {Box3{{0, 0, 0}, {12, 10, 8}}, Box3{{1, 1, 1}, {11, 9, 7}}, Box3{{0.5, 0, 1}, {10, 9, 8}}}) {
        const Diagram diagram(points, box);
        CHECK(diagram.volume() == Approx(box.volume()).epsilon(1e-14));
        CHECK(diagram.closed(points.size()));
        std::vector<int> walls(points.size());
        for (const VoronoiWall& wall : diagram.complex.walls) {
            CHECK(wall.end - wall.begin == 4);
            ++walls[wall.cell];
            if (wall.beyond >= 0) {
                ++walls[static_cast<std::size_t>(wall.beyond)];
            }
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            CHECK((walls[i] == 6 || (walls[i] == 0 && diagram.measures.volume[i] == 0)));
        }
    }
}

TEST_CASE("Lattices of inexact numbers, points on spheres and slivers leave cells closed") {
    Random random(3);
    for (int kind = 0; kind < 3; ++kind) {
        const Box3 box{{0, 0, 0}, {1, 1, 1}};
        std::vector<Vec3> points;
        for (int i = 0; i <= 10; ++i) {
            for (int j = 0; j <= 10; ++j) {
                for (int k = 0; k <= 10 && kind == 0; ++k) {
                    points.push_back({0.1 * i, 0.1 * j, 0.1 * k});
                }
                const double u = 0.6 * i;
                const double v = 0.3 * j + 0.1;
                if (kind == 1) {
                    points.push_back(Vec3{0.5, 0.5, 0.5} +
                                     0.4 * Vec3{std::cos(u) * std::sin(v), std::sin(u) * std::sin(v), std::cos(v)});
                } else if (kind == 2) {  // nearly in one plane
                    points.push_back({0.1 * i, 0.1 * j, 0.5 + 1e-13 * random.in(box).x});
                }
            }
        }
        if (kind > 0) {
            add_corners(box, points);
        }
        const Diagram diagram(points, box);
        INFO(kind);
        CHECK(diagram.volume() == Approx(1).epsilon(1e-12));
        CHECK(diagram.closed(points.size()));
        CHECK(diagram.worst_corner(points) < 1e-9);
    }
}

TEST_CASE("Volumes and areas of walls are those of voro++") {
    Random random(5);
    const Box3 box{{0, 0, 0}, {100, 80, 60}};
    std::vector<Vec3> points;
    for (int i = 0; i < 2000; ++i) {
        points.push_back(random.in(box));
    }
    const Diagram diagram(points, box);
    std::map<std::pair<int, int>, double> areas;
    for (std::size_t w = 0; w < diagram.complex.walls.size(); ++w) {
        const VoronoiWall& wall = diagram.complex.walls[w];
        const double area = length(diagram.measures.area[w]);
        areas[{static_cast<int>(wall.cell), wall.beyond}] = area;
        if (wall.beyond >= 0) {
            areas[{wall.beyond, static_cast<int>(wall.cell)}] = area;
        }
    }
    voro::container container(0, 100, 0, 80, 0, 60, 8, 7, 6, false, false, false, 8);
    for (std::size_t i = 0; i < points.size(); ++i) {
        container.put(static_cast<int>(i), points[i].x, points[i].y, points[i].z);
    }
    voro::c_loop_all loop(container);
    voro::voronoicell_neighbor cell;
    std::size_t compared = 0;
    if (loop.start()) {
        do {
            REQUIRE(container.compute_cell(cell, loop));
            const auto i = static_cast<std::size_t>(loop.pid());
            CHECK(std::abs(cell.volume() - diagram.measures.volume[i]) <= 1e-9 * cell.volume());
            std::vector<int> neighbours;
            std::vector<double> face_areas;
            cell.neighbors(neighbours);
            cell.face_areas(face_areas);
            for (std::size_t f = 0; f < neighbours.size(); ++f) {
                const auto found = areas.find({static_cast<int>(i), neighbours[f]});
                const double area = found == areas.end() ? 0 : found->second;
                CHECK(std::abs(area - face_areas[f]) <= 1e-9 * cell.surface_area());
                ++compared;
            }
        } while (loop.inc());
    }
    CHECK(compared > 25000);
}
