// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier_query.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <thread>

#include "support.hpp"

namespace terratet {
namespace {

/// A wavy sheet over [0, width]², its margin a ring of one more row, and a protection radius to match the spacing.
Barrier wavy_fault(const Vec3& at, double width, int rows, double protection) {
    Barrier fault;
    fault.protection_radius = protection;
    for (int j = -1; j <= rows + 1; ++j) {
        for (int i = -1; i <= rows + 1; ++i) {
            const double x = width * i / rows;
            const double y = width * j / rows;
            fault.sheet.vertices.push_back(at + Vec3{x, y, 5 * std::sin(0.05 * x) * std::cos(0.03 * y)});
        }
    }
    fault.margin.vertices = fault.sheet.vertices;
    const auto stride = static_cast<std::uint32_t>(rows + 3);
    for (std::uint32_t j = 0; j + 1 < stride; ++j) {
        for (std::uint32_t i = 0; i + 1 < stride; ++i) {
            const std::uint32_t a = j * stride + i;
            const bool inside = i > 0 && j > 0 && i + 2 < stride && j + 2 < stride;
            Surface& part = inside ? fault.sheet : fault.margin;
            part.triangles.push_back({a, a + 1, a + stride + 1});
            part.triangles.push_back({a, a + stride + 1, a + stride});
        }
    }
    return fault;
}

double distance_to(const Surface& surface, const Vec3& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const Triangle& t : surface.triangles) {
        least = std::min(least, distance(p, closest_point_on_triangle(p, surface.vertices[t[0]], surface.vertices[t[1]],
                                                                      surface.vertices[t[2]])));
    }
    return least;
}

std::int32_t protecting_by_definition(std::span<const Barrier> faults, const Vec3& p) {
    for (std::size_t f = 0; f < faults.size(); ++f) {
        if (std::min(distance_to(faults[f].sheet, p), distance_to(faults[f].margin, p)) < faults[f].protection_radius) {
            return static_cast<std::int32_t>(f);
        }
    }
    return -1;
}

bool crosses_by_definition(const Surface& surface, const Vec3& a, const Vec3& b) {
    using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
    const auto point = [](const Vec3& p) { return Exact::Point_3(p.x, p.y, p.z); };
    const Exact::Segment_3 segment(point(a), point(b));
    for (const Triangle& t : surface.triangles) {
        const Exact::Triangle_3 triangle(point(surface.vertices[t[0]]), point(surface.vertices[t[1]]),
                                         point(surface.vertices[t[2]]));
        if (a == b ? triangle.has_on(point(a)) : CGAL::do_intersect(segment, triangle)) {
            return true;
        }
    }
    return false;
}

}  // namespace

TEST_CASE("A point is protected exactly where its distance to sheet or margin is below the protection radius") {
    const std::vector<Barrier> faults = {wavy_fault({0, 0, 0}, 100, 8, 9), wavy_fault({60, 60, 20}, 80, 16, 3),
                                         wavy_fault({-500, 0, 0}, 4, 1, 0.1)};
    const BarrierQuery proximity(faults);
    testing::Random random(7);
    std::size_t near = 0;
    for (int i = 0; i < 20000; ++i) {
        Vec3 p = random.in({{-30, -30, -30}, {180, 180, 60}});
        if (i % 4 == 0) {  // right at the limit of one of them
            const Barrier& fault = faults[random.below(2)];
            const Vec3& on = fault.sheet.vertices[random.below(fault.sheet.vertices.size())];
            p = on + fault.protection_radius * random(0.999, 1.001) * Vec3{0, 0, 1};
        }
        const std::int32_t expected = protecting_by_definition(faults, p);
        near += expected >= 0 ? 1 : 0;
        REQUIRE(proximity.protecting_barrier(p) == expected);
    }
    CHECK(near > 3000);
    CHECK(proximity.protecting_barrier({-500, 1, 0.05}) == 2);
    CHECK(proximity.protecting_barrier({1e9, -1e9, 1e9}) == -1);
    CHECK(proximity.protecting_barrier({std::nan(""), 0, 0}) == -1);
}

TEST_CASE("Protection is exact for triangles a thousand times larger than the radius") {
    Barrier fault;
    fault.protection_radius = 1;
    fault.sheet.vertices = {{0, 0, 0}, {1000, 0, 700}, {0, 1000, 300}};
    fault.sheet.triangles = {{0, 1, 2}};
    const std::vector<Barrier> faults = {fault};
    const BarrierQuery proximity(faults);
    testing::Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const double u = random(-0.1, 1.1);
        const double v = random(-0.1, 1.1);
        const Vec3 p = {1000 * u, 1000 * v, 700 * u + 300 * v + random(-3, 3)};
        REQUIRE(proximity.protecting_barrier(p) == protecting_by_definition(faults, p));
    }
}

TEST_CASE("Segments cross a sheet as exact arithmetic says, touching and degenerate ones included") {
    const std::vector<Barrier> faults = {wavy_fault({0, 0, 0}, 100, 8, 9), wavy_fault({60, 60, 20}, 80, 16, 3)};
    const BarrierQuery proximity(faults);
    testing::Random random(11);
    std::size_t crossing = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 a = random.in({{-30, -30, -30}, {180, 180, 60}});
        const Vec3 b = a + random.in({{-40, -40, -40}, {40, 40, 40}});
        const bool first = crosses_by_definition(faults[0].sheet, a, b);
        const bool second = crosses_by_definition(faults[1].sheet, a, b);
        crossing += first || second ? 1 : 0;
        REQUIRE(proximity.crosses(0, a, b) == first);
        REQUIRE(proximity.crosses(1, a, b) == second);
        REQUIRE(proximity.crosses_any(a, b) == (first || second));
        REQUIRE(proximity.crosses_any(a, b, 0) == second);
        REQUIRE(proximity.crosses_any(a, b, 1) == first);
    }
    CHECK(crossing > 100);
    const Surface& sheet = faults[0].sheet;
    const Vec3 corner = sheet.vertices[sheet.triangles[5][0]];
    const Vec3 other = sheet.vertices[sheet.triangles[5][1]];
    CHECK(proximity.crosses(0, corner, corner));                  // a point on the sheet
    CHECK(proximity.crosses(0, corner, other));                   // along an edge
    CHECK(proximity.crosses(0, corner, corner + Vec3{0, 0, 3}));  // from the sheet upwards
    CHECK_FALSE(proximity.crosses(0, corner + Vec3{0, 0, 1e-9}, corner + Vec3{0, 0, 3}));
    CHECK_FALSE(proximity.crosses(0, corner + Vec3{0, 0, 1}, corner + Vec3{0, 0, 1}));
    // The margin protects but is no barrier.
    CHECK_FALSE(proximity.crosses(0, {-5, 50, -20}, {-5, 50, 20}));
}

TEST_CASE("The distance to a sheet is that to its nearest triangle, margins not counted") {
    const std::vector<Barrier> faults = {wavy_fault({0, 0, 0}, 100, 8, 9), Barrier{}};
    const BarrierQuery proximity(faults);
    testing::Random random(13);
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random.in({{-60, -60, -60}, {160, 160, 60}});
        REQUIRE(proximity.distance_to_sheet(0, p) == Approx(distance_to(faults[0].sheet, p)).epsilon(1e-12));
    }
    CHECK(std::isinf(proximity.distance_to_sheet(1, {0, 0, 0})));
    CHECK_FALSE(proximity.crosses(1, {0, 0, -1}, {0, 0, 1}));
    CHECK_FALSE(proximity.empty());
    CHECK(BarrierQuery({}).empty());
    CHECK(BarrierQuery({}).protecting_barrier({0, 0, 0}) == -1);
}

TEST_CASE("Queries from several threads agree with those from one") {
    const std::vector<Barrier> faults = {wavy_fault({0, 0, 0}, 100, 30, 3), wavy_fault({60, 60, 20}, 80, 16, 3)};
    const BarrierQuery proximity(faults);
    const auto digest = [&] {
        testing::Random random(17);
        double sum = 0;
        for (int i = 0; i < 3000; ++i) {
            const Vec3 a = random.in({{-30, -30, -30}, {180, 180, 60}});
            const Vec3 b = random.in({{-30, -30, -30}, {180, 180, 60}});
            sum += proximity.distance_to_sheet(i % 2, a) + proximity.protecting_barrier(a) +
                   (proximity.crosses_any(a, b) ? 10 : 0);
        }
        return sum;
    };
    std::vector<double> sums(4);
    std::vector<std::thread> threads;
    for (double& sum : sums) {
        threads.emplace_back([&] { sum = digest(); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const double sum : sums) {
        CHECK(sum == digest());
    }
}

}  // namespace terratet
