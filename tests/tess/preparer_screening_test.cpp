// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tess/barrier/prepare/prepare.hpp"
#include "tests/tess/worlds.hpp"

namespace terratet {
namespace {

using Catch::Matchers::Contains;

/// Points at random in the unit square, put in place by `map`, triangulated as a table of them is.
template <class Map>
Surface cloud(int count, std::uint64_t seed, const Map& map) {
    testing::Random random(seed);
    std::vector<Vec3> points;
    for (int i = 0; i < count; ++i) {
        const double u = random();
        const double v = random();
        points.push_back(map(u, v, random));
    }
    return triangulate_in_best_fit_plane("cloud", std::move(points));
}

struct Outcome {
    BarrierPreparation preparation;
    std::set<std::string> stages;
};

Outcome prepared(const Surface& surface, double l_min) {
    Box3 extent = bounding_box(surface.vertices);
    Outcome outcome;
    outcome.preparation =
        prepare_barriers({surface}, extent.grown(l_min), {}, l_min, {}, [&](std::string_view stage, double) {
            outcome.stages.emplace(stage);
            return true;
        });
    return outcome;
}

bool is_tangle(const Surface& surface) {
    const Outcome outcome = prepared(surface, 100);
    return outcome.preparation.accounts.at(0).reason.find("is no surface but a tangle") == 0;
}

double height(testing::Random& random, double deviation) {  // of four uniform ones: bell-shaped enough
    return deviation * std::sqrt(3.0) * (random(-1, 1) + random(-1, 1) + random(-1, 1) + random(-1, 1)) / 2;
}

Surface wall(const std::string& name, double x, double half_width = 3000) {
    return testing::planar_fault(name, {x, 0, 0}, 0, 90, half_width, half_width, 20000);
}

const Box3 around_walls{{-4000, -4000, -4000}, {4000, 4000, 4000}};

BarrierPreparation walls(double apart, const BarrierOptions& options) {
    return prepare_barriers({wall("F1", 0), wall("F2", apart, 2900)}, around_walls, {}, 1000, options);
}

}  // namespace

TEST_CASE("Points that are no graph over their plane are refused before anything is meshed") {
    const auto box = [](double u, double v, testing::Random& random) {
        return Vec3{1400 * u, 1500 * v, random(-250, 220)};
    };
    const auto folded = [](double u, double v, testing::Random&) {  // overturned twice
        return Vec3{1000 * u + 350 * std::sin(12.56 * u), 1000 * v, 300 * std::sin(6.28 * u)};
    };
    const auto spiky = [](double u, double v, testing::Random& random) {
        return Vec3{1000 * u, 1000 * v, random() < 0.2 ? random(-300, 300) : 0};
    };
    const auto tube = [](double u, double v, testing::Random&) {
        return Vec3{300 * std::cos(6.28 * u), 1000 * v, 300 * std::sin(6.28 * u)};
    };
    for (const Surface& surface :
         {cloud(1500, 1, box), cloud(1500, 2, folded), cloud(1500, 3, spiky), cloud(600, 4, tube)}) {
        const Outcome outcome = prepared(surface, 100);
        const BarrierAccount& account = outcome.preparation.accounts.at(0);
        CHECK_FALSE(account.used);
        CHECK_THAT(account.reason, Contains("is no surface but a tangle"));
        CHECK(account.area_refused + account.area_outside == Approx(account.area_in));
        CHECK(outcome.stages.count("meshing faults") == 0);
    }
}

TEST_CASE("Rough, bent and sparse points are no tangle") {
    const auto rough = [](double u, double v, testing::Random& random) {
        return Vec3{1000 * u, 1000 * v, height(random, 10)};  // a third of the points' distance
    };
    const auto half_tube = [](double u, double v, testing::Random&) {
        return Vec3{300 * std::cos(3.14 * u), 1000 * v, 300 * std::sin(3.14 * u)};
    };
    const auto outliers = [](double u, double v, testing::Random& random) {
        return Vec3{1000 * u, 1000 * v, random() < 0.01 ? random(-300, 300) : 0};
    };
    CHECK_FALSE(is_tangle(cloud(1000, 5, rough)));
    CHECK_FALSE(is_tangle(cloud(1000, 6, half_tube)));
    CHECK_FALSE(is_tangle(cloud(1000, 7, outliers)));
    CHECK_FALSE(is_tangle(cloud(8, 8, rough)));
}

TEST_CASE("Walls that nowhere meet are two faults: the spacing is to blame, and the one that keeps both is named") {
    const BarrierPreparation coarse = walls(500, {});
    REQUIRE(coarse.barriers.size() == 1);
    const std::string& reason = coarse.accounts.at(1).reason;
    CHECK_THAT(reason, Contains("runs alongside fault 'F1' at a distance of 500"));
    CHECK_THAT(reason, Contains("`barriers.spacing` of 660 keeps both"));
    BarrierOptions finer;
    finer.spacing = 660;
    CHECK(walls(500, finer).barriers.size() == 2);
    CHECK(walls(900, {}).barriers.size() == 2);
}

TEST_CASE("The spacing that separates faults is found for any distance, and keeps both") {
    for (const double apart : {50.0, 120.0, 333.0, 590.0}) {
        INFO(apart);
        const std::vector<Surface> surfaces = {wall("F1", 0), wall("F2", apart, 2900)};
        BarrierOptions options;
        options.spacing = separating_spacing(surfaces, around_walls, {}, 1000, {}, {});
        CHECK(options.spacing < 1000);
        CHECK(options.spacing > apart);
        if (apart > 100) {  // a spacing of 66 m takes a while
            CHECK(walls(apart, options).barriers.size() == 2);
        }
    }
    CHECK(separating_spacing({wall("F1", 0), wall("F2", 900)}, around_walls, {}, 1000, {}, {}) == 1000);
    CHECK(separating_spacing({wall("F1", 0), wall("F2", 1)}, around_walls, {}, 1000, {}, {}) == 1000);  // 1e8 seeds
}

TEST_CASE("Surfaces that run together and meet are versions of one fault, at any spacing") {
    const std::vector<Surface> surfaces = {wall("F1", 0),
                                           testing::planar_fault("F2", {20, 0, 0}, 1, 90, 2900, 2900, 20000)};
    const BarrierPreparation preparation = prepare_barriers(surfaces, around_walls, {}, 1000);
    REQUIRE(preparation.barriers.size() == 1);
    CHECK_THAT(preparation.accounts.at(1).reason, Contains("alternative versions of one fault"));
    CHECK(separating_spacing(surfaces, around_walls, {}, 1000, {}, {}) == 1000);
}

TEST_CASE("Fault preparation stops at any of its reports of progress") {
    const std::vector<Surface> surfaces = {wall("F1", 0), wall("F2", 900),
                                           testing::planar_fault("G", {0, 0, 0}, 60, 60, 4000, 4000, 500)};
    for (const SeedMode mode : {SeedMode::paired, SeedMode::exact}) {
        BarrierOptions options;
        options.mode = mode;
        std::map<std::string, int> reports;
        std::map<std::string, double> last;
        const auto count = [&](std::string_view stage, double fraction) {
            double& before = last.try_emplace(std::string(stage), 0).first->second;
            CHECK(fraction >= before);
            CHECK(fraction <= 1);
            before = fraction;
            ++reports[std::string(stage)];
            return true;
        };
        CHECK(prepare_barriers(surfaces, around_walls, {}, 1000, options, count).barriers.size() == 3);
        int all = 0;
        for (const auto& [stage, times] : reports) {
            INFO(stage << ": " << times);
            CHECK(times >= (stage == "meshing faults" || stage == "sealing faults" ? 10 : 1));
            all += times;
        }
        CHECK(reports.size() == 6);
        for (int stop = 0; stop < all; stop += std::max(1, all / 8)) {
            int reported = 0;
            const auto cancel = [&](std::string_view, double) { return reported++ < stop; };
            CHECK_THROWS_AS(prepare_barriers(surfaces, around_walls, {}, 1000, options, cancel), Cancelled);
            CHECK(reported == stop + 1);
        }
    }
}

}  // namespace terratet
