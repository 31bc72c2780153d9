// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tess/criteria.hpp"
#include "tess/error.hpp"
#include "tess/frame.hpp"
#include "tess/mesh/quality.hpp"
#include "tess/property.hpp"
#include "tests/support.hpp"

using namespace terratet;

TEST_CASE("The nearest point of a triangle is nearer than any of a dense sample of it") {
    testing::Random random(1);
    const Box3 box{{-1, -1, -1}, {1, 1, 1}};
    for (int round = 0; round < 300; ++round) {
        const Vec3 a = random.in(box);
        const Vec3 b = random.in(box);
        const Vec3 c = random.in(box);
        const Vec3 p = 2 * random.in(box);
        const double found = distance(p, closest_point_on_triangle(p, a, b, c));
        double sampled = 1e9;
        for (int i = 0; i <= 40; ++i) {
            for (int j = 0; i + j <= 40; ++j) {
                const double u = i / 40.0;
                const double v = j / 40.0;
                sampled = std::min(sampled, distance(p, a + u * (b - a) + v * (c - a)));
            }
        }
        CHECK(found <= sampled + 1e-12);
        CHECK(found >= sampled - 0.1);
    }
}

TEST_CASE("A frame takes true coordinates to local ones and back exactly") {
    testing::Random random(2);
    const std::vector<Box3> extents{{{525000, 6791000, -1000}, {526000, 6793000, 20}},
                                    {{2288231.4, 413722.81, 1528}, {2306237.25, 425038.9, 1633.3}},
                                    {{-500, -500, -500}, {500, 500, 500}},
                                    {{1, 1, 1}, {3000, 3000, 3000}},
                                    {{-526000, -6793000, -20}, {-525000, -6791000, -1}},
                                    {{5e8, 5e8, 0}, {9e8, 6e8, 1}}};
    for (const Box3& extent : extents) {
        Frame frame;
        frame.origin = choose_origin(extent);
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(std::fmod(frame.origin[axis], 1024) == 0);
        }
        for (int i = 0; i < 2000; ++i) {
            const Vec3 world = random.in(extent);
            CHECK(frame.to_world(frame.to_local(world)) == world);
            const Vec3 snapped = frame.snapped(frame.to_local(world) / 3);
            CHECK(frame.to_local(frame.to_world(snapped)) == snapped);
        }
    }
    Frame utm;
    utm.origin = choose_origin(extents[0]);
    CHECK(std::abs(utm.origin.y - 6792000) < 1024);
    CHECK(utm.origin.z == 0);
}

TEST_CASE("The regular cell has the textbook's measures") {
    const CellPoints regular{Vec3{1, 1, 1}, Vec3{1, -1, -1}, Vec3{-1, 1, -1}, Vec3{-1, -1, 1}};
    const CellQuality q = cell_quality(regular);
    CHECK(q.aspect == Approx(3));
    CHECK(q.radius_edge == Approx(std::sqrt(6.0) / 4));
    CHECK(q.dihedral_min_deg == Approx(70.528779));
    CHECK(q.dihedral_max_deg == Approx(70.528779));
    CHECK(q.volume == Approx(8.0 / 3));
    CHECK(cell_sharpness(regular) == Approx(1.0 / 9));
}

TEST_CASE("A flat cell has infinite aspect and no dihedral angle, and no number is NaN") {
    const CellPoints flat{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}};
    const CellQuality q = cell_quality(flat);
    CHECK(std::isinf(q.aspect));
    CHECK(std::isinf(q.circumradius));
    CHECK(q.dihedral_min_deg == 0);
    CHECK(std::isinf(cell_sharpness({Vec3{}, Vec3{}, Vec3{}, Vec3{}})));
}

TEST_CASE("Quality does not depend on the order of the corners") {
    testing::Random random(3);
    for (int i = 0; i < 200; ++i) {
        CellPoints p{};
        for (Vec3& corner : p) {
            corner = random.in({{0, 0, 0}, {1, 1, 1}});
        }
        const CellQuality a = cell_quality(p);
        std::swap(p[0], p[2]);
        std::swap(p[1], p[3]);
        const CellQuality b = cell_quality({p[1], p[0], p[2], p[3]});
        CHECK(a.aspect == Approx(b.aspect));
        CHECK(a.dihedral_min_deg == Approx(b.dihedral_min_deg));
        CHECK(a.circumradius == Approx(b.circumradius));
    }
}

TEST_CASE("A property's specification is parsed, and what is wrong with it is named") {
    const Property k = parse_property("K:log10:unit=m/s");
    CHECK(k.name == "K");
    CHECK(k.scale == Scale::log10);
    CHECK(k.unit == "m/s");
    CHECK(parse_property("LITH:categorical").kind == Kind::categorical);
    CHECK_THROWS_WITH(parse_property("K:cubic"), Catch::Contains("'cubic'"));
    CHECK_THROWS_AS(parse_property(""), UsageError);
    CHECK_THROWS_AS(parse_property("L:categorical:log10"), UsageError);
}

TEST_CASE("Differences are taken in the property's scale") {
    const Property k = parse_property("K:log10");
    CHECK(scaled_difference(k, 1e-12, 1e-8) == Approx(4));
    CHECK(scaled_difference(k, 1e-12, NAN) == 0);
    CHECK(scaled_difference(k, 1e-12, -1) == 0);
    CHECK(from_scale(k, to_scale(k, 3e-9)) == Approx(3e-9));
    const Property lithology = parse_property("L:categorical");
    CHECK(scaled_difference(lithology, 1, 1) == 0);
    CHECK(std::isinf(scaled_difference(lithology, 1, 2)));
}

TEST_CASE("Criteria that contradict each other are refused") {
    const auto broken = [](auto change) {
        Criteria criteria;
        criteria.l_min = 20;
        criteria.l_max = 80;
        change(criteria);
        return criteria;
    };
    CHECK_NOTHROW(validate(broken([](Criteria&) {})));
    CHECK_THROWS_AS(validate(broken([](Criteria& c) { c.l_min = 0; })), UsageError);
    CHECK_THROWS_AS(validate(broken([](Criteria& c) { c.l_min = NAN; })), UsageError);
    CHECK_THROWS_AS(validate(broken([](Criteria& c) { c.l_max = 10; })), UsageError);
    CHECK_THROWS_AS(validate(broken([](Criteria& c) { c.aspect = 2; })), UsageError);
    CHECK_THROWS_AS(validate(broken([](Criteria& c) { c.radius_edge = 0.5; })), UsageError);
    CHECK_THROWS_AS(validate(broken([](Criteria& c) { c.variation = {{2, 1}}; })), UsageError);
    CHECK_THROWS_AS(validate(broken([](Criteria& c) { c.v_max = -1; })), UsageError);
}

TEST_CASE("A frame with stretched z brings snapped points back to the very same doubles") {
    testing::Random random(31);
    for (const double scale : {1.0, 2.0, 3.0, 7.5, 10.0, 49.0, 250.0, 0.1, 1 / 3.0}) {
        for (const double origin : {0.0, 1024.0, -4096.0}) {
            Frame frame;
            frame.origin = {525312, 6792192, origin};
            frame.z_scale = scale;
            for (int i = 0; i < 2000; ++i) {
                const Vec3 world{random(524000, 527000), random(6790000, 6794000), origin + random(-900, 900)};
                const Vec3 local = frame.snapped(frame.to_local(world));
                REQUIRE(frame.snapped(local) == local);
                REQUIRE(frame.to_local(frame.to_world(local)) == local);
                REQUIRE(distance(frame.to_world(local), world) < 1e-9);
                REQUIRE(std::abs(local.z - scale * (world.z - origin)) < 1e-9 * scale);
            }
        }
    }
}
