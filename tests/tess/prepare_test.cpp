// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/prepare/prepare.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "tess/error.hpp"
#include "tests/tess/fault_cases.hpp"

namespace terratet {
namespace {

using testing::cylinder;
using testing::dipping;
using testing::gridded;
using testing::rectangle;
using testing::wavy;

const Box3 extent{{0, 0, 0}, {400, 400, 400}};
constexpr double spacing = 20;

BarrierPreparation prepared(const std::vector<Surface>& surfaces, const BarrierOptions& options = {}) {
    return prepare_barriers(surfaces, extent, {}, spacing, options);
}

void check_promises(const std::vector<Surface>& surfaces, const BarrierPreparation& preparation,
                    const BarrierOptions& options = {}) {
    testing::check_promises(surfaces, preparation, extent, spacing, options);
}

Box3 hull(const BarrierOptions& options = {}) {
    return extent.grown(hull_margin(options, spacing));
}

double sheet_area(const Barrier& fault) {
    double sum = 0;
    for (const Triangle& t : fault.sheet.triangles) {
        sum += 0.5 * length(cross(fault.sheet.vertices[t[1]] - fault.sheet.vertices[t[0]],
                                  fault.sheet.vertices[t[2]] - fault.sheet.vertices[t[0]]));
    }
    return sum;
}

void check_covering(const Barrier& fault, std::uint64_t random_seed) {
    testing::Random random(random_seed);
    for (const Surface* part : {&fault.sheet, &fault.margin}) {
        for (int i = 0; i < 300 && !part->triangles.empty(); ++i) {
            const Triangle& t = part->triangles[random.below(part->triangles.size())];
            const double u = random();
            const double v = random(0, 1 - u);
            const Vec3 a = part->vertices[t[0]];
            const Vec3 x = a + u * (part->vertices[t[1]] - a) + v * (part->vertices[t[2]] - a);
            double least = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < fault.seeds.size(); k += 2) {
                least = std::min(least, distance(x, 0.5 * (fault.seeds[k].position + fault.seeds[k + 1].position)));
            }
            REQUIRE(least <= fault.covering_radius * (1 + 1e-9));
        }
    }
}

/// F1 at the protection radius; returns the crossings at 0.9 of it.
std::size_t check_f1(const std::vector<Surface>& surfaces, std::size_t background = 8000) {
    const BarrierPreparation preparation = prepared(surfaces);
    check_promises(surfaces, preparation);
    REQUIRE_FALSE(preparation.barriers.empty());
    if (preparation.barriers.size() == 1) {  // beside others a margin has gaps
        check_covering(preparation.barriers[0], 3);
    }
    const auto counted = testing::count_crossings(preparation.barriers, hull(), background, 1, 5);
    CHECK(counted.background == background);
    CHECK(counted.paired > 50);
    CHECK(counted.crossing == 0);
    return testing::count_crossings(preparation.barriers, hull(), background, 0.9, 5).crossing;
}

Surface l_shaped() {
    Surface surface;
    surface.name = "L";
    surface.vertices = {{80, 80, 190},   {320, 80, 200},  {320, 200, 205},
                        {200, 200, 200}, {200, 320, 205}, {80, 320, 200}};
    // All in the plane z = 190 + (x − 80)/24 + (y − 80)/24, near enough to test that flat need not mean exact.
    surface.triangles = {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}};
    return surface;
}

Surface zigzag(double fold_deg) {
    const double rise = 25 * std::tan(0.5 * fold_deg * std::numbers::pi / 180);
    return gridded("zigzag", 20, 1, [=](double u, double v) {
        const int k = static_cast<int>(std::lround(20 * u)) % 4;
        return Vec3{500 * u - 50, 500 * v - 50, 200 + rise * (k < 2 ? k : 4 - k)};
    });
}

}  // namespace

TEST_CASE("F1: no edge but its own crosses a plane, and nearer than the protection radius some do") {
    CHECK(check_f1({rectangle("plane", {200, 200, 205}, {300, 0, 0}, {0, 300, 0})}) > 20);
}

TEST_CASE("F1: no edge but its own crosses a tilted plane through the whole extent") {
    CHECK(check_f1({dipping("tilted", {200, 200, 200}, 30, 60, 600, 600)}, 20000) > 0);
}

TEST_CASE("F1: no edge but its own crosses a fault that ends inside the extent") {
    CHECK(check_f1({rectangle("half", {100, 200, 200}, {150, 0, 30}, {0, 120, 10})}) > 5);
}

TEST_CASE("F1: no edge but its own crosses an L-shaped fault") {
    CHECK(check_f1({l_shaped()}) > 20);
}

TEST_CASE("F1: no edge but its own crosses a cylinder, a wavy surface, or zigzags") {
    check_f1({cylinder(160)});
    check_f1({cylinder(400)});
    check_f1({wavy()});
    check_f1({zigzag(10)});
    check_f1({zigzag(30)});
}

TEST_CASE("F1: no edge but their own crosses nearly parallel faults, or faults that cross each other") {
    const std::vector<Surface> parallel = {rectangle("a", {200, 200, 200}, {300, 0, 0}, {0, 300, 0}),
                                           rectangle("b", {200, 200, 240}, {300, 0, 15}, {0, 280, 0})};
    CHECK(check_f1(parallel) > 20);
    const std::vector<Surface> crossing = {rectangle("a", {200, 200, 200}, {300, 0, 0}, {0, 300, 0}),
                                           rectangle("b", {200, 200, 200}, {0, 300, 0}, {100, 0, 290}),
                                           dipping("c", {100, 300, 200}, 120, 70, 150, 150)};
    check_f1(crossing);
    const BarrierPreparation preparation = prepared(crossing);
    REQUIRE(preparation.barriers.size() == 3);
    const BarrierQuery proximity(preparation.barriers);
    CHECK(proximity.meet(0, 1));
    CHECK(proximity.meet(1, 0));
    for (const BarrierAccount& account : preparation.accounts) {
        CHECK(account.area_trimmed == 0);
    }
}

TEST_CASE("F1: no edge but its own crosses random planes at dips from 15 to 90 degrees") {
    testing::Random random(19);
    std::size_t too_near = 0;
    for (int i = 0; i < 16; ++i) {
        const double dip = 15 + 5 * i;
        const Vec3 center = random.in({{120, 120, 120}, {280, 280, 280}});
        too_near += check_f1({dipping("random", center, random(0, 360), dip, random(60, 500), random(60, 500))}, 4000);
    }
    CHECK(too_near > 50);
}

TEST_CASE("F4: the areas of accounts add up on a hundred random sets of faults, and every surface is listed") {
    testing::Random random(23);
    for (int run = 0; run < 100; ++run) {
        std::vector<Surface> surfaces;
        const std::uint64_t count = 1 + random.below(4);
        for (std::uint64_t k = 0; k < count; ++k) {
            const Vec3 center = random.in(extent.grown(150));
            surfaces.push_back(dipping("f" + std::to_string(k), center, random(0, 360), random(5, 90), random(5, 400),
                                       random(5, 400)));
        }
        BarrierOptions options;
        options.spacing = 40;
        options.width = random(2, 40);
        check_promises(surfaces, prepare_barriers(surfaces, extent, {}, spacing, options), options);
    }
}

TEST_CASE("A grid whose spacing suits keeps its points: 15 × 31 at 20 m stay these 465") {
    const Surface grid = gridded("grid", 14, 30, [](double u, double v) {
        return Vec3{60 + 280 * u * 0.8, 30 + 280 * u * 0.6, 20 + 600 * v * 0.5};
    });
    Surface twenty = grid;
    for (int j = 0; j <= 30; ++j) {
        for (int i = 0; i <= 14; ++i) {
            twenty.vertices[static_cast<std::size_t>(j * 15 + i)] = Vec3{60 + 16.0 * i, 30 + 12.0 * i, -300 + 20.0 * j};
        }
    }
    const Box3 tall{{0, 0, -400}, {400, 400, 400}};
    const BarrierPreparation preparation = prepare_barriers({twenty}, tall, {}, 20);
    REQUIRE(preparation.barriers.size() == 1);
    const Barrier& fault = preparation.barriers[0];
    CHECK(preparation.accounts[0].deviation_max < 1e-9);
    std::size_t found = 0;
    std::size_t within = 0;
    for (std::size_t k = 0; k < fault.seeds.size(); k += 2) {
        const Vec3 base = 0.5 * (fault.seeds[k].position + fault.seeds[k + 1].position);
        const bool in_rectangle =
            base.x > 60 - 1e-6 && base.x < 60 + 224 + 1e-6 && base.z > -300 - 1e-6 && base.z < 300 + 1e-6;
        within += in_rectangle ? 1 : 0;
        for (const Vec3& p : twenty.vertices) {
            found += distance(p, base) < 1e-9 ? 1 : 0;
        }
    }
    CHECK(found == 465);
    CHECK(within == 465);
    CHECK(fault.covering_radius == Approx(20 / std::numbers::sqrt2).epsilon(1e-4));
    CHECK(fault.protection_radius == Approx(std::sqrt(200 + 2.5 * 2.5)).epsilon(1e-4));
}

TEST_CASE("The result depends neither on the order of surfaces nor on that of vertices and triangles") {
    std::vector<Surface> surfaces = {dipping("a", {200, 200, 200}, 30, 60, 300, 300),
                                     rectangle("b", {200, 200, 200}, {0, 300, 0}, {100, 0, 290}), wavy()};
    surfaces[2].vertices[100].z += 3;
    const BarrierPreparation first = prepared(surfaces);
    testing::Random random(29);
    std::swap(surfaces[0], surfaces[2]);
    for (Surface& surface : surfaces) {
        std::vector<std::uint32_t> place(surface.vertices.size());
        for (std::size_t i = 0; i < place.size(); ++i) {
            place[i] = static_cast<std::uint32_t>(i);
        }
        for (std::size_t i = place.size(); i-- > 1;) {
            std::swap(place[i], place[random.below(i + 1)]);
        }
        std::vector<Vec3> vertices(place.size());
        for (std::size_t i = 0; i < place.size(); ++i) {
            vertices[place[i]] = surface.vertices[i];
        }
        surface.vertices = vertices;
        for (Triangle& t : surface.triangles) {
            t = {place[t[0]], place[t[1]], place[t[2]]};
            std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random.below(3)), t.end());
        }
        for (std::size_t i = surface.triangles.size(); i-- > 1;) {
            std::swap(surface.triangles[i], surface.triangles[random.below(i + 1)]);
        }
    }
    const BarrierPreparation second = prepared(surfaces);
    CHECK(first.barriers == second.barriers);
    REQUIRE(first.accounts.size() == second.accounts.size());
    for (std::size_t i = 0; i < first.accounts.size(); ++i) {
        CHECK(first.accounts[i].name == second.accounts[i].name);
        CHECK(first.accounts[i].reason == second.accounts[i].reason);
        CHECK(first.accounts[i].area_used == second.accounts[i].area_used);
    }
}

TEST_CASE("Faults go on beyond the extent, and stop before the hull box") {
    const BarrierPreparation preparation = prepared({rectangle("a", {200, 200, 200}, {192, 0, 0}, {0, 300, 0})});
    REQUIRE(preparation.barriers.size() == 1);  // its rims lie 8 from two faces, within snap, and beyond the other two
    const Barrier& fault = preparation.barriers[0];
    CHECK(sheet_area(fault) == Approx(400 * 400).epsilon(1e-9));
    Box3 margin = bounding_box(fault.margin.vertices);
    CHECK(margin.lo.x < -fault.protection_radius);
    CHECK(margin.hi.x > 400 + fault.protection_radius);
    CHECK(hull().grown(-0.9 * spacing).contains(margin.lo));
    CHECK(hull().grown(-0.9 * spacing).contains(margin.hi));
    CHECK(preparation.accounts[0].area_used == Approx(384 * 400).epsilon(1e-9));
}

TEST_CASE("What cannot be used is refused with its reason") {
    const auto reason = [](const std::vector<Surface>& surfaces, std::size_t which = 0) {
        const BarrierPreparation preparation = prepared(surfaces);
        check_promises(surfaces, preparation);
        return preparation.accounts[which].reason;
    };
    CHECK(reason({rectangle("far", {2000, 200, 200}, {100, 0, 0}, {0, 100, 0})}) == "lies wholly outside the extent");
    CHECK(reason({Surface{"empty", SurfaceKind::fault, {}, {}, ""}}) == "has no triangle with an area");
    CHECK(reason({rectangle("line", {200, 200, 200}, {100, 0, 0}, {50, 0, 0})}) == "has no triangle with an area");
    CHECK(reason({zigzag(100)}).find("exact") != std::string::npos);
    Surface tangle = wavy();  // its triangles between random corners
    testing::Random random(37);
    for (Triangle& t : tangle.triangles) {
        for (std::uint32_t& v : t) {
            v = static_cast<std::uint32_t>(random.below(tangle.vertices.size()));
        }
    }
    CHECK(reason({tangle}).find("no surface") != std::string::npos);
    const std::vector<Surface> alternatives = {rectangle("a", {200, 200, 200}, {300, 0, 0}, {0, 300, 0}),
                                               rectangle("b", {200, 200, 206}, {280, 0, 8}, {0, 300, 0})};
    CHECK(reason(alternatives).find("overlaps fault 'b'") !=
          std::string::npos);  // b, tilted, is the larger, and they meet
    Surface horizon = rectangle("h", {200, 200, 200}, {300, 0, 0}, {0, 300, 0});
    horizon.kind = SurfaceKind::horizon;
    CHECK(prepared({horizon}).accounts.at(0).used);  // surfaces of all kinds are prepared alike
}

TEST_CASE("A fault that bends too much for the spacing gets a finer one") {
    const std::vector<Surface> surfaces = {gridded("sharp", 60, 4, [](double u, double v) {
        const double angle = (u - 0.5) * 3;
        return Vec3{200 + 45 * std::sin(angle), 400 * v, 200 + 45 * std::cos(angle)};
    })};
    const BarrierPreparation preparation = prepared(surfaces);
    check_promises(surfaces, preparation);
    REQUIRE(preparation.barriers.size() == 1);
    CHECK(preparation.accounts[0].finest_spacing < spacing);
    CHECK(testing::count_crossings(preparation.barriers, hull(), 8000, 1, 7).crossing == 0);
}

TEST_CASE("Contradictory fault options and too many seeds are errors") {
    const std::vector<Surface> surfaces = {rectangle("a", {200, 200, 200}, {300, 0, 0}, {0, 300, 0})};
    BarrierOptions options;
    options.width = 30;
    CHECK_THROWS_AS(prepared(surfaces, options), UsageError);
    options.width = -1;
    CHECK_THROWS_AS(prepared(surfaces, options), UsageError);
    options.width = std::nan("");
    CHECK_THROWS_AS(prepared(surfaces, options), UsageError);
    options = {};
    options.max_seeds = 100;
    CHECK_THROWS_WITH(prepared(surfaces, options), Catch::Matchers::Contains("max_seeds"));
    options = {};
    options.spacing = 1e-3;
    CHECK_THROWS_AS(prepared(surfaces, options), Error);
}

TEST_CASE("Seeds lie where a stored model puts them back: true coordinates are doubles") {
    Frame frame;
    frame.origin = {512000, 6700032, 0};
    const BarrierPreparation preparation =
        prepare_barriers({dipping("tilted", {200, 200, 200}, 30, 60, 600, 600)}, extent, frame, spacing);
    REQUIRE(preparation.barriers.size() == 1);
    for (const Seed& seed : preparation.barriers[0].seeds) {
        REQUIRE(frame.snapped(seed.position) == seed.position);
    }
    for (const Vec3& p : preparation.barriers[0].sheet.vertices) {
        REQUIRE(frame.snapped(p) == p);
    }
    CHECK(testing::count_crossings(preparation.barriers, hull(), 8000, 1, 7).crossing == 0);
}

}  // namespace terratet
