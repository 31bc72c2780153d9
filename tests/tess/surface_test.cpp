// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/surface.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>
#include <set>

#include "support.hpp"

using namespace terratet;

namespace {

/// Points on a plane through `origin` that dips `dip_deg` towards `direction_deg` (clockwise from +y).
struct Plane {
    Vec3 origin, strike, down;
    Plane(const Vec3& at, double dip_deg, double direction_deg) : origin(at) {
        const double dip = dip_deg * std::numbers::pi / 180, direction = direction_deg * std::numbers::pi / 180;
        down = {std::cos(dip) * std::sin(direction), std::cos(dip) * std::cos(direction), -std::sin(dip)};
        strike = {std::cos(direction), -std::sin(direction), 0};
    }
    [[nodiscard]] Vec3 at(double s, double d) const { return origin + s * strike + d * down; }
};

std::vector<Vec3> grid(const Plane& plane, int columns, int rows, double spacing) {
    std::vector<Vec3> points;
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            points.push_back(plane.at(i * spacing, j * spacing));
        }
    }
    return points;
}

Vec3 normal(const Surface& s, const Triangle& t) {
    return cross(s.vertices[t[1]] - s.vertices[t[0]], s.vertices[t[2]] - s.vertices[t[0]]);
}

void shuffle(std::vector<Vec3>& points, testing::Random& random) {
    for (std::size_t i = points.size(); i > 1; --i) {
        std::swap(points[i - 1], points[random.below(i)]);
    }
}

/// Area of a planar polygon by the shoelace sum in 3D.
double ring_area(const std::vector<Vec3>& ring) {
    Vec3 sum;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        sum = sum + cross(ring[i] - ring[0], ring[(i + 1) % ring.size()] - ring[0]);
    }
    return length(sum) / 2;
}

double area_of(const std::vector<std::vector<Vec3>>& rings, const std::vector<Triangle>& triangles) {
    std::vector<Vec3> p;
    for (const auto& ring : rings) {
        p.insert(p.end(), ring.begin(), ring.end());
    }
    double sum = 0;
    for (const Triangle& t : triangles) {
        sum += length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) / 2;
    }
    return sum;
}

}  // namespace

TEST_CASE("Statistics of a plane are its area, dip and dip direction, whichever way its triangles turn") {
    testing::Random random(1);
    for (int i = 0; i < 200; ++i) {
        const double dip = random(1, 89), direction = random(0, 360);
        Surface s;
        const Plane plane({4e5, 6.8e6, -300}, dip, direction);
        s.vertices = {plane.at(0, 0), plane.at(40, 0), plane.at(40, 30), plane.at(0, 30)};
        s.triangles = {{0, 1, 2}, {0, 3, 2}};
        if (random.below(2)) {
            std::swap(s.triangles[0][1], s.triangles[0][2]);
        }
        const SurfaceStatistics got = statistics(s);
        CHECK(got.area == Approx(1200).epsilon(1e-7));
        CHECK(got.dip_mean_deg == Approx(dip).margin(1e-5));
        CHECK(got.dip_min_deg == Approx(dip).margin(1e-5));
        CHECK(got.dip_max_deg == Approx(dip).margin(1e-5));
        CHECK(std::abs(std::remainder(got.dip_direction_deg - direction, 360)) < 1e-4);
    }
}

TEST_CASE("Statistics weigh by area and leave what is undefined at zero") {
    Surface s;
    CHECK(statistics(s).area == 0);
    CHECK(statistics(s).dip_max_deg == 0);
    // Horizontal 1 × 1 (two triangles), vertical 3 × 1 below its edge: mean dip (1·0 + 3·90) / 4.
    s.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, -3}, {1, 0, -3}};
    s.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {4, 5, 1}, {2, 2, 3}};
    const SurfaceStatistics got = statistics(s);
    CHECK(got.area == Approx(4));
    CHECK(got.dip_mean_deg == Approx(67.5));
    CHECK(got.dip_min_deg == 0);
    CHECK(got.dip_max_deg == Approx(90));
    s.triangles.resize(2);
    CHECK(statistics(s).dip_direction_deg == 0);  // horizontal
}

TEST_CASE("Points of the paper's fault, 15 by 31 at 20 m, triangulate to the whole rectangle with normals up") {
    for (const double dip : {0.0, 12.0, 45.0, 89.0}) {
        auto points = grid(Plane({7.5e5, 6.7e6, 0}, dip, 210), 15, 31, 20);
        const Surface s = triangulate_in_best_fit_plane("fault", points);
        CHECK(s.name == "fault");
        CHECK(s.vertices.size() == 465);
        CHECK(s.triangles.size() == 2 * 14 * 30);
        CHECK(statistics(s).area == Approx(14 * 20 * 30 * 20.0));
        CHECK(statistics(s).dip_mean_deg == Approx(dip).margin(1e-4));
        for (const Triangle& t : s.triangles) {
            REQUIRE(normal(s, t).z > 0);
        }
    }
}

TEST_CASE("A triangulation of points does not depend on their order nor on repeated ones") {
    testing::Random random(2);
    for (int i = 0; i < 50; ++i) {
        auto points = grid(Plane({7.5e5, 6.7e6, 0}, random(0, 90), random(0, 360)), 6, 7, 20);
        for (Vec3& p : points) {
            p = p + Vec3{random(-3, 3), random(-3, 3), random(-3, 3)};
        }
        const Surface first = triangulate_in_best_fit_plane("f", points);
        points.push_back(points[3]);
        shuffle(points, random);
        REQUIRE(triangulate_in_best_fit_plane("f", points) == first);
        REQUIRE(std::is_sorted(first.vertices.begin(), first.vertices.end()));
        REQUIRE(std::is_sorted(first.triangles.begin(), first.triangles.end()));
    }
}

TEST_CASE("A triangulation of points is Delaunay in its plane and covers their convex hull") {
    testing::Random random(3);
    const Plane plane({0, 0, 0}, 60, 130);
    std::vector<Vec3> points;
    std::vector<std::array<double, 2>> flat;
    for (int i = 0; i < 300; ++i) {
        flat.push_back({random(0, 100), random(0, 100)});
        points.push_back(plane.at(flat.back()[0], flat.back()[1]));
    }
    const Surface s = triangulate_in_best_fit_plane("f", points);
    // Euler: n points, h of them on the hull, make 2n − 2 − h triangles.
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const Triangle& t : s.triangles) {
        for (int k = 0; k < 3; ++k) {
            edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
        }
    }
    const auto hull = std::count_if(edges.begin(), edges.end(), [&](const auto& e) { return edges.count(e) == 1; });
    CHECK(s.vertices.size() == 300);
    CHECK(s.triangles.size() == 2 * 300 - 2 - static_cast<std::size_t>(hull));
    for (const Triangle& t : s.triangles) {  // by definition: no point in a circumcircle (a sphere on a plane)
        const Vec3 a = s.vertices[t[0]], b = s.vertices[t[1]] - a, c = s.vertices[t[2]] - a;
        const Vec3 n = cross(b, c);
        const Vec3 center =
            a + (squared_length(b) * cross(c, n) + squared_length(c) * cross(n, b)) / (2 * squared_length(n));
        const double radius = distance(center, a);
        for (const Vec3& p : s.vertices) {
            REQUIRE(distance(p, center) > radius * (1 - 1e-9));
        }
    }
}

TEST_CASE("Too few and collinear points give no triangles, and points collinear but for rounding neither") {
    CHECK(triangulate_in_best_fit_plane("f", {}).triangles.empty());
    CHECK(triangulate_in_best_fit_plane("f", {{0, 0, 0}, {1, 1, 1}}).triangles.empty());
    CHECK(triangulate_in_best_fit_plane("f", {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {0, 0, 0}}).triangles.empty());
    testing::Random random(4);
    for (int i = 0; i < 100; ++i) {
        const Vec3 direction{random(-1, 1), random(-1, 1), random(-1, 1)};
        std::vector<Vec3> line;
        for (int k = 0; k < 40; ++k) {
            line.push_back(Vec3{5e5, 6e6, 0} + k * direction);
        }
        const Surface s = triangulate_in_best_fit_plane("f", line);
        REQUIRE(s.triangles.empty());
        REQUIRE(s.vertices.empty());
    }
}

TEST_CASE("An edge limit keeps a concave outline open and zero keeps its bridge") {
    auto points = grid(Plane({0, 0, 0}, 0, 0), 21, 21, 1);
    std::erase_if(points, [](const Vec3& p) { return p.x > 5.5 && p.y > 5.5; });
    const auto bridged = triangulate_in_best_fit_plane("f", points);
    const auto open = triangulate_in_best_fit_plane("f", points, 3);
    CHECK(statistics(bridged).area == Approx(287.5));
    CHECK(statistics(open).area == Approx(20 * 5 + 15 * 5).margin(4));
    CHECK(open.vertices.size() == points.size());
}

TEST_CASE("A polygon is triangulated whole: concave, with holes, in any plane, turning as its outer ring") {
    testing::Random random(5);
    for (int i = 0; i < 100; ++i) {
        const Plane plane({6e5, 5e6, -100}, random(0, 90), random(0, 360));
        std::vector<Vec3> star;
        const int spikes = 3 + static_cast<int>(random.below(12));
        for (int k = 0; k < 2 * spikes; ++k) {
            const double angle = std::numbers::pi * k / spikes, radius = k % 2 ? random(15, 20) : random(30, 60);
            star.push_back(plane.at(radius * std::cos(angle), radius * std::sin(angle)));
        }
        std::vector<Vec3> hole;
        for (int k = 0; k < 5; ++k) {
            const double angle = 2 * std::numbers::pi * k / 5;
            hole.push_back(plane.at(5 * std::cos(angle), 5 * std::sin(angle)));
        }
        std::vector<std::vector<Vec3>> rings{star};
        if (i % 2) {
            rings.push_back(hole);
        }
        if (i % 3 == 0) {
            std::reverse(rings[0].begin(), rings[0].end());
        }
        const auto triangles = triangulate_polygon(rings);
        const std::size_t corners = rings[0].size() + (i % 2 ? hole.size() : 0);
        REQUIRE(triangles.size() == corners - 2 + (i % 2 ? 2 : 0));
        REQUIRE(area_of(rings, triangles) == Approx(ring_area(star) - (i % 2 ? ring_area(hole) : 0)).epsilon(1e-7));
        Vec3 turn;
        for (std::size_t k = 0; k < star.size(); ++k) {
            turn = turn + cross(rings[0][k] - star[0], rings[0][(k + 1) % star.size()] - star[0]);
        }
        std::vector<Vec3> p = rings[0];
        p.insert(p.end(), hole.begin(), hole.end());
        for (const Triangle& t : triangles) {
            REQUIRE(dot(turn, cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) > 0);
        }
    }
}

TEST_CASE("A polygon that crosses itself, repeats a corner or has no area gives no triangles") {
    const auto none = [](const std::vector<Vec3>& ring) {
        return triangulate_polygon(std::vector<std::vector<Vec3>>{ring}).empty();
    };
    CHECK(none({{0, 0, 0}, {3, 3, 0}, {3, 0, 0}, {0, 2, 0}}));             // bow tie
    CHECK(none({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {0, 1, 0}}));  // the first corner again
    CHECK(none({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}));
    CHECK(none({{0, 0, 0}, {1, 0, 0}}));
    CHECK(triangulate_polygon({}).empty());
    CHECK(triangulate_polygon(std::vector<std::vector<Vec3>>{{{0, 0, 0}, {1, 0, 5}, {0, 1, 2}}}) ==
          std::vector<Triangle>{{0, 1, 2}});
}

TEST_CASE(
    "Surfaces of one name have one order, whatever the order of their corners and triangles, and where they lie") {
    Surface small = triangulate_in_best_fit_plane("f", grid({{500, 0, 0}, 40, 70}, 5, 6, 10));
    Surface large = triangulate_in_best_fit_plane("f", grid({{0, 0, 0}, 60, 120}, 8, 6, 10));
    small.file = "z.ts";
    large.file = "a.ts";
    testing::Random random(3);
    for (int i = 0; i < 20; ++i) {
        CHECK(canonical_before(small, large));
        CHECK_FALSE(canonical_before(large, small));
        CHECK_FALSE(canonical_before(small, small));
        for (Surface* surface : {&small, &large}) {
            std::ranges::reverse(surface->vertices);
            const auto last = static_cast<std::uint32_t>(surface->vertices.size()) - 1;
            for (Triangle& t : surface->triangles) {
                t = {last - t[2], last - t[0], last - t[1]};
            }
            std::swap(surface->triangles[random.below(surface->triangles.size())], surface->triangles.front());
            std::swap(surface->file, surface == &small ? large.file : small.file);
        }
    }
    large.name = "e";
    CHECK(canonical_before(large, small));
    Surface broken = small;
    broken.triangles.push_back({0, 1, 1000000});
    CHECK_FALSE(canonical_before(broken, broken));
}
