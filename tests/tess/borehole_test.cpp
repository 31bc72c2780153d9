// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/borehole.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "support.hpp"

using namespace terratet;

namespace {

bool near(const Vec3& a, const Vec3& b, double tolerance) {
    return distance(a, b) <= tolerance;
}

std::vector<SurveyStation> random_survey(testing::Random& random) {
    std::vector<SurveyStation> stations;
    double depth = random.below(2) == 0 ? 0 : random(0, 30);
    for (std::uint64_t n = 1 + random.below(12); n > 0; --n) {
        stations.push_back({depth, random(0, 360), random(0, 180)});
        depth += random(0.5, 60);
    }
    return stations;
}

}  // namespace

TEST_CASE("minimum curvature reproduces the drilling textbook's example") {
    // I 15° → 25°, Az 20° → 45° over 100 ft: N 27.22, E 19.45, TVD 94.01.
    const Trajectory hole(Vec3{}, {{0, 20, 15}, {100, 45, 25}});
    const Vec3 end = hole.position(100);
    CHECK(end.y == Approx(27.22).margin(0.005).epsilon(0));
    CHECK(end.x == Approx(19.45).margin(0.005).epsilon(0));
    CHECK(-end.z == Approx(94.01).margin(0.005).epsilon(0));
}

TEST_CASE("a hole without survey is vertical") {
    const Trajectory hole(Vec3{10, 20, 30}, {});
    CHECK(hole.position(0) == Vec3{10, 20, 30});
    CHECK(hole.position(12.5) == Vec3{10, 20, 17.5});
}

TEST_CASE("the first direction holds up to the collar and the last one below the survey") {
    const Trajectory hole(Vec3{}, {{50, 90, 90}, {20, 90, 90}});
    CHECK(near(hole.position(10), {10, 0, 0}, 1e-12));
    CHECK(near(hole.position(80), {80, 0, 0}, 1e-12));
    CHECK(hole.stations().front() == SurveyStation{0, 90, 90});
}

TEST_CASE("of stations at equal depth the first counts, in whatever order the depths come") {
    const Trajectory hole(Vec3{}, {{30, 0, 0}, {0, 90, 90}, {0, 270, 90}});
    CHECK(near(hole.position(1e-6), {1e-6, 0, 0}, 1e-12));
}

TEST_CASE("a quarter circle is followed along its arc") {
    // From straight down to due east over 100: radius 200/π.
    const double radius = 200 / std::acos(-1.0);
    const Trajectory hole(Vec3{}, {{0, 90, 0}, {100, 90, 90}});
    for (const double depth : {0.0, 25.0, 50.0, 99.0, 100.0}) {
        const double angle = depth / radius;
        CHECK(near(hole.position(depth), {radius * (1 - std::cos(angle)), 0, -radius * std::sin(angle)}, 1e-10));
    }
}

TEST_CASE("tangential keeps the upper direction, balanced tangential changes half way") {
    const std::vector<SurveyStation> survey{{0, 90, 0}, {100, 90, 90}, {200, 90, 90}};
    const Trajectory tangential(Vec3{}, survey, Desurvey::tangential);
    CHECK(near(tangential.position(100), {0, 0, -100}, 1e-12));
    CHECK(near(tangential.position(150), {50, 0, -100}, 1e-12));
    const Trajectory balanced(Vec3{}, survey, Desurvey::balanced_tangential);
    CHECK(near(balanced.position(40), {0, 0, -40}, 1e-12));
    CHECK(near(balanced.position(100), {50, 0, -50}, 1e-12));
}

TEST_CASE("arcs have unit speed: the length of 200 random paths is their measured depth") {
    testing::Random random(20260101);
    double worst = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const std::vector<SurveyStation> survey = random_survey(random);
        const Trajectory hole({1000, 2000, 300}, survey);
        const double deepest = survey.back().depth + random(1, 50);
        const int steps = 20000;
        double path = 0;
        Vec3 last = hole.position(0);
        for (int i = 1; i <= steps; ++i) {
            const Vec3 next = hole.position(deepest * i / steps);
            path += distance(last, next);
            last = next;
        }
        worst = std::max(worst, std::abs(path - deepest) / deepest);
    }
    INFO("worst relative error of the path length: " << worst);
    CHECK(worst < 1e-6);
}

TEST_CASE("position is continuous at stations for every method") {
    testing::Random random(7);
    for (const Desurvey method : {Desurvey::minimum_curvature, Desurvey::tangential, Desurvey::balanced_tangential}) {
        for (int trial = 0; trial < 100; ++trial) {
            const Trajectory hole(Vec3{}, random_survey(random), method);
            for (const SurveyStation& station : hole.stations()) {
                CHECK(near(hole.position(station.depth - 1e-9), hole.position(station.depth + 1e-9), 1e-8));
            }
        }
    }
}

TEST_CASE("opposite directions still give a path that is finite and as long as measured") {
    const Trajectory hole(Vec3{}, {{0, 0, 0}, {10, 0, 180}});
    CHECK(near(hole.position(10), {0, 0, 0}, 1e-12));
    CHECK(near(hole.position(5), {0, 0, -5}, 1e-12));
    CHECK(is_finite(Trajectory(Vec3{}, {{0, 0, 0}, {10, 0, 179.99999}}).position(3)));
}

TEST_CASE("the polyline of a hole stays on its path and turns by no more than asked") {
    testing::Random random(11);
    for (int trial = 0; trial < 50; ++trial) {
        const std::vector<SurveyStation> survey = random_survey(random);
        const Trajectory hole(Vec3{}, survey);
        const double deepest = survey.back().depth * random(0.2, 1.5) + 1;
        const std::vector<double> depths = hole.polyline_depths(deepest, 2);
        REQUIRE(depths.front() == 0);
        REQUIRE(depths.back() == deepest);
        CHECK(std::ranges::adjacent_find(depths, std::ranges::greater_equal{}) == depths.end());
        for (std::size_t i = 0; i + 1 < depths.size(); ++i) {
            // A chord under an arc of angle β is shorter by β²/24: 2° make 5e-5.
            const double chord = distance(hole.position(depths[i]), hole.position(depths[i + 1]));
            CHECK(chord >= (depths[i + 1] - depths[i]) * (1 - 6e-5) - 1e-12);
        }
    }
    CHECK(Trajectory(Vec3{}, {}).polyline_depths(0) == std::vector<double>{0});
    CHECK(Trajectory(Vec3{}, {{0, 0, 0}, {100, 90, 90}}, Desurvey::balanced_tangential).polyline_depths(200) ==
          std::vector<double>{0, 50, 100, 200});
}
