// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "support.hpp"
#include "tess/outline.hpp"

using namespace terratet;

namespace {

Surface domain_of(const Rings& rings) {
    Surface surface;
    surface.name = "site";
    surface.kind = SurfaceKind::domain;
    for (const auto& ring : rings) {
        surface.vertices.insert(surface.vertices.end(), ring.begin(), ring.end());
    }
    surface.triangles = triangulate_polygon(rings);
    REQUIRE(!surface.triangles.empty());
    return surface;
}

Rings concave() {
    return {{{0, 0, 0}, {400, 20, 0}, {380, 500, 0}, {220, 500, 0}, {230, 250, 0}, {10, 240, 0}},
            {{80, 80, 0}, {80, 170, 0}, {240, 170, 0}, {240, 80, 0}}};
}

/// Even-odd, edge by edge.
bool inside(const Rings& rings, const Vec3& p) {
    bool result = false;
    for (const auto& ring : rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec3& a = ring[i];
            const Vec3& b = ring[(i + 1) % ring.size()];
            if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) {
                result = !result;
            }
        }
    }
    return result;
}

}  // namespace

TEST_CASE("A polygon's outline is its boundary, with its holes, whatever the order of its triangles") {
    OutlineReport report;
    Surface surface = domain_of(concave());
    const Rings rings = outline_of({surface}, 30, report);
    REQUIRE(rings.size() == 2);
    CHECK(report.corners == 10);
    CHECK(report.deviation == 0);
    CHECK(area(rings) == Approx(area(concave())));
    const Outline outline(rings);
    testing::Random random(1);
    for (int i = 0; i < 20000; ++i) {
        const Vec3 p = random.in({{-50, -50, -9}, {450, 550, 9}});
        REQUIRE(outline.contains(p) == inside(concave(), p));
    }
    CHECK(Outline({}).contains({1e8, -1e8, 0}));
    std::ranges::reverse(surface.triangles);
    for (Triangle& t : surface.triangles) {
        std::swap(t[0], t[2]);
    }
    CHECK(outline_of({surface}, 30, report) == rings);
}

TEST_CASE("An outline finer than the spacing is drawn to it, not crossing itself, and rings too small go") {
    Rings rings(1);
    testing::Random random(7);
    for (int i = 0; i < 3000; ++i) {
        const double angle = 2 * std::numbers::pi * i / 3000;
        const double r = 300 + 40 * std::sin(5 * angle) + random(-0.2, 0.2);
        rings[0].push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    rings.push_back({{0, 0, 0}, {0, 9, 0}, {9, 0, 0}});
    OutlineReport report;
    const Rings drawn = outline_of({domain_of(rings)}, 20, report);
    REQUIRE(drawn.size() == 1);
    CHECK(report.dropped == 1);
    CHECK(report.corners_in == 3003);
    CHECK(report.corners < 100);
    CHECK(report.deviation < 0.15 * 20);
    CHECK(area(drawn) == Approx(area(rings)).epsilon(0.01));
    CHECK(!triangulate_polygon(drawn).empty());  // which it is not for rings that cross themselves
    std::size_t brief = 0;
    for (std::size_t i = 0; i < drawn[0].size(); ++i) {
        brief += distance(drawn[0][i], drawn[0][(i + 1) % drawn[0].size()]) < 0.7 * 20 ? 1 : 0;
    }
    CHECK(brief == 0);
    CHECK(outline_of({domain_of({{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}}})}, 20, report).empty());
}

TEST_CASE("Walls stand on the edges in the extent, face outwards, and meet others of another surface") {
    const Box3 extent{{-100, -100, -50}, {400, 450, 80}};  // the east side runs along its face or beyond
    Rings rings{{{0, 0, 0}, {400, 0, 0}, {400, 500, 0}, {0, 500, 0}, {-40, 200, 0}}};
    const std::vector<Surface> walls = domain_walls(rings, "site", "site.gpkg", extent, 30);
    const Outline outline(rings);
    double area_there = 0;
    std::map<Vec3, std::set<std::string>> users;
    for (const Surface& wall : walls) {
        CHECK(wall.kind == SurfaceKind::domain);
        for (const Triangle& t : wall.triangles) {
            const Vec3& a = wall.vertices[t[0]];
            const Vec3 normal = cross(wall.vertices[t[1]] - a, wall.vertices[t[2]] - a);
            const Vec3 middle = (a + wall.vertices[t[1]] + wall.vertices[t[2]]) / 3;
            CHECK(normal.z == 0);
            CHECK(outline.contains(middle - 1e-3 / length(normal) * normal));
            CHECK(!outline.contains(middle + 1e-3 / length(normal) * normal));
            area_there += length(normal) / 2;
        }
        for (const Vec3& p : wall.vertices) {
            users[p].insert(wall.name);
            CHECK((p.z == -80 || p.z == 110));
        }
    }
    const double perimeter = 400 + std::hypot(40, 300) + std::hypot(40, 200);  // without the east and north sides
    CHECK(area_there == Approx(perimeter * 190));
    CHECK(users[{0, 0, -80}].size() == 2);
    CHECK(users[{-40, 200, 110}].size() == 2);
    CHECK(length_inside({0, 0, 0}, {0, 900, 0}, extent) == Approx(450));
    CHECK(length_inside({400, 0, 0}, {400, 100, 0}, extent) == 0);
    CHECK(length_inside({500, 0, 0}, {500, 100, 0}, extent) == 0);
    CHECK(length_inside({-200, -200, 0}, {500, 500, 0}, extent) == Approx(500 * std::numbers::sqrt2));
}
