// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Made-up faults of every shape and meeting, in both modes: F1 against a tessellation straight from CGAL, F2 against
// points whose side is known by construction, certificates against the nearest seed.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "tess/barrier/seeds/seal.hpp"
#include "tess/base/seed_grid.hpp"
#include "tests/tess/fault_cases.hpp"

namespace terratet {
namespace {

using testing::dipping;
using testing::gridded;
using testing::rectangle;

const Box3 extent{{0, 0, 0}, {400, 400, 400}};
constexpr double spacing = 20;

struct Case {
    std::string name;
    std::vector<Surface> surfaces;
};

/// A horizontal fault, and one that rises from its middle at the angle.
std::vector<Surface> branching(double angle_deg) {
    const double angle = angle_deg * std::numbers::pi / 180;
    const Vec3 up = {std::cos(angle), 0, std::sin(angle)};
    const Surface branch = gridded("branch", 1, 1, [=](double u, double v) {
        return Vec3{200, -300 + 1000 * u, 200} + 600 * v * up;
    });
    return {rectangle("main", {200, 200, 200}, {600, 0, 0}, {0, 500, 0}), branch};
}

std::vector<Case> cases() {
    std::vector<Case> all;
    all.push_back({"plane", {rectangle("plane", {200, 200, 205}, {300, 0, 0}, {0, 300, 0})}});
    all.push_back({"half", {rectangle("half", {100, 200, 200}, {150, 0, 30}, {0, 120, 10})}});
    all.push_back({"cylinder", {gridded("cylinder", 24, 20, [](double u, double v) {
                       const double angle = (u - 0.5) * 2;
                       return Vec3{200 + 160 * std::sin(angle), 800 * v - 200, 40 + 160 * std::cos(angle)};
                   })}});
    all.push_back({"wavy", {gridded("wavy", 40, 40, [](double u, double v) {
                       return Vec3{600 * u - 100, 600 * v - 100, 200 + 15 * std::sin(10 * u) * std::cos(9 * v)};
                   })}});
    for (const double angle : {90.0, 70.0, 50.0, 35.0, 20.0}) {
        all.push_back({"Y of " + std::to_string(std::lround(angle)) + " degrees", branching(angle)});
    }
    all.push_back({"X",
                   {rectangle("a", {200, 200, 200}, {300, 0, 0}, {0, 300, 0}),
                    rectangle("b", {200, 200, 200}, {0, 300, 0}, {100, 0, 290})}});
    all.push_back({"three through a point",
                   {rectangle("a", {200, 200, 200}, {300, 0, 0}, {0, 300, 0}),
                    rectangle("b", {200, 200, 200}, {0, 300, 0}, {100, 0, 290}),
                    rectangle("c", {200, 200, 200}, {300, 0, 40}, {0, 60, 300})}});
    return all;
}

/// Each prepared once: several tests look at them.
const BarrierPreparation& prepared(const Case& made_up, SeedMode mode) {
    static std::map<std::pair<std::string, SeedMode>, BarrierPreparation> done;
    const auto [entry, fresh] = done.try_emplace({made_up.name, mode});
    if (fresh) {
        BarrierOptions options;
        options.mode = mode;
        entry->second = prepare_barriers(made_up.surfaces, extent, {}, spacing, options);
    }
    return entry->second;
}

/// Points on sheets with what is known of them: the fault, its normal, whether the triangle is certified.
template <class Visit>
void sample_sheets(const BarrierPreparation& preparation, std::size_t count, std::uint64_t seed, const Visit& visit) {
    testing::Random random(seed);
    for (std::size_t i = 0; i < count; ++i) {
        const auto f = static_cast<std::size_t>(random.below(preparation.barriers.size()));
        const Surface& sheet = preparation.barriers[f].sheet;
        const auto t = static_cast<std::size_t>(random.below(sheet.triangles.size()));
        const Vec3 a = sheet.vertices[sheet.triangles[t][0]];
        const Vec3 b = sheet.vertices[sheet.triangles[t][1]];
        const Vec3 c = sheet.vertices[sheet.triangles[t][2]];
        const double u = random(0.001, 0.998);
        const double v = random(0.001, 0.999 - u);
        const Vec3 n = cross(b - a, c - a);
        if (length(n) > 1e-3) {
            visit(f, a + u * (b - a) + v * (c - a), n / length(n), preparation.certified[f][t] != 0);
        }
    }
}

}  // namespace

TEST_CASE("F1: in both modes no foreign edge crosses faults of any shape and meeting") {
    for (const Case& made_up : cases()) {
        for (const SeedMode mode : {SeedMode::paired, SeedMode::exact}) {
            INFO(made_up.name << (mode == SeedMode::exact ? ", exact" : ", paired"));
            const BarrierPreparation& preparation = prepared(made_up, mode);
            CHECK(preparation.barriers.size() == made_up.surfaces.size());
            BarrierOptions options;
            options.mode = mode;
            const Box3 hull = extent.grown(hull_margin(options, spacing));
            const auto counted = testing::count_crossings(preparation.barriers, hull, 3000, 1, 5);
            CHECK(counted.paired > 50);
            CHECK(counted.crossing == 0);
        }
    }
}

TEST_CASE("F1: without the flakes that seal sharp wedges edges would cross there, and a hole in the cover is filled") {
    const Case wedge{"Y of 20 degrees", branching(20)};
    BarrierOptions options;
    options.mode = SeedMode::exact;
    const Box3 hull = extent.grown(hull_margin(options, spacing));
    std::vector<Barrier> faults = prepared(wedge, SeedMode::exact).barriers;
    for (Barrier& fault : faults) {
        std::erase_if(fault.margin.triangles, [&](const Triangle& t) {
            const auto& p = fault.margin.vertices;
            return distance(p[t[0]], p[t[1]]) < 0.01 * spacing && distance(p[t[0]], p[t[2]]) < 0.01 * spacing;
        });
    }
    CHECK(testing::count_crossings(faults, hull, 3000, 1, 5).crossing > 3);

    faults = prepared(cases().front(), SeedMode::paired).barriers;
    REQUIRE(faults.size() == 1);
    const std::size_t before = faults[0].seeds.size();
    for (std::size_t k = before; k > 0; k -= 2) {
        if (distance(faults[0].seeds[k - 1].position, {200, 200, 205}) < 2 * spacing) {
            faults[0].seeds.erase(faults[0].seeds.begin() + static_cast<std::ptrdiff_t>(k) - 2,
                                  faults[0].seeds.begin() + static_cast<std::ptrdiff_t>(k));
        }
    }
    REQUIRE(faults[0].seeds.size() < before);
    CHECK(testing::count_crossings(faults, hull, 3000, 1, 5).crossing > 3);
    std::size_t asked_before = 0;
    Seal seal = seal_sheets(faults, hull, {}, [&](double share) { asked_before += share == 0 ? 1 : 0; });
    CHECK(asked_before > faults[0].seeds.size() / 512);  // getting ready can be stopped, too
    CHECK(seal.open.empty());
    CHECK(seal.seeds[0].size() > faults[0].seeds.size());
    faults[0].seeds = seal.seeds[0];
    const auto first = static_cast<std::uint32_t>(faults[0].margin.vertices.size());
    for (const Triangle& t : seal.flakes[0].triangles) {
        faults[0].margin.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    faults[0].margin.vertices.insert(faults[0].margin.vertices.end(), seal.flakes[0].points.begin(),
                                     seal.flakes[0].points.end());
    CHECK(testing::count_crossings(faults, hull, 3000, 1, 5).crossing == 0);
}

TEST_CASE("F2: of a million points beside faults none is told to be on the wrong side") {
    std::size_t tested = 0;
    std::size_t wrong = 0;
    for (const Case& made_up : cases()) {
        const BarrierPreparation& preparation = prepared(made_up, SeedMode::exact);
        const BarrierQuery proximity(preparation.barriers);
        sample_sheets(preparation, 16000, 7, [&](std::size_t f, const Vec3& x, const Vec3& n, bool) {
            for (const double away : {1e-7, 1e-3, 0.1}) {
                for (const std::int8_t side : {std::int8_t{1}, std::int8_t{-1}}) {
                    const Vec3 p = x + side * away * spacing * n;
                    wrong += proximity.side_of(static_cast<std::int32_t>(f), p) == side ? 0 : 1;
                    ++tested;
                }
            }
        });
    }
    CHECK(tested > 1'000'000);
    CHECK(wrong == 0);
}

TEST_CASE("F2: on certified triangles the nearest seed tells the side, however near the point") {
    for (const Case& made_up : cases()) {
        INFO(made_up.name);
        const BarrierPreparation& preparation = prepared(made_up, SeedMode::exact);
        std::vector<Vec3> places;
        std::vector<std::pair<std::size_t, std::int8_t>> what;
        for (std::size_t f = 0; f < preparation.barriers.size(); ++f) {
            for (const Seed& seed : preparation.barriers[f].seeds) {
                places.push_back(seed.position);
                what.emplace_back(f, seed.side);
            }
        }
        const SeedGrid seeds(places, 2 * spacing);
        const BarrierQuery proximity(preparation.barriers);
        std::size_t wrong = 0;
        std::size_t certified = 0;
        sample_sheets(preparation, 20000, 9, [&](std::size_t f, const Vec3& x, const Vec3& n, bool is_certified) {
            for (const std::int8_t side : {std::int8_t{1}, std::int8_t{-1}}) {
                const Vec3 p = x + side * 1e-7 * spacing * n;
                if (is_certified) {
                    const std::uint32_t nearest = seeds.nearest(p);
                    wrong += what[nearest] == std::pair(f, side) ? 0 : 1;
                    wrong += proximity.crosses_any(p, places[nearest]) ? 1 : 0;
                    ++certified;
                }
            }
        });
        CHECK(certified > 10000);
        CHECK(wrong == 0);
    }
}

TEST_CASE("Nearly all triangles of made-up faults are certified away from junctions and rims") {
    for (const Case& made_up : cases()) {
        INFO(made_up.name);
        const BarrierPreparation& preparation = prepared(made_up, SeedMode::exact);
        std::map<std::pair<Vec3, Vec3>, int> uses;
        for (const Barrier& fault : preparation.barriers) {
            for (const Triangle& t : fault.sheet.triangles) {
                for (std::size_t k = 0; k < 3; ++k) {
                    ++uses[std::minmax(fault.sheet.vertices[t[k]], fault.sheet.vertices[t[(k + 1) % 3]])];
                }
            }
        }
        std::vector<Vec3> ends;  // of rims and junctions; where the extent cuts is a rim as well
        for (const auto& [edge, count] : uses) {
            if (count != 2) {
                ends.push_back(edge.first);
                ends.push_back(edge.second);
            }
        }
        const SeedGrid grid(ends, 2.5 * spacing);
        std::size_t uncertified = 0;
        std::size_t clear = 0;
        sample_sheets(preparation, 5000, 11, [&](std::size_t, const Vec3& x, const Vec3&, bool is_certified) {
            if (grid.nearest(x) == no_index) {
                ++clear;
                uncertified += is_certified ? 0 : 1;
            }
        });
        CHECK(clear > 300);
        CHECK(uncertified <= clear / 100);
    }
}

}  // namespace terratet
