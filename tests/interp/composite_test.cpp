// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/composite.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "support.hpp"
#include "tess/property.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

/// One vertical hole from (0, 0, 0) down.
Site site_of(const std::vector<std::array<double, 4>>& intervals) {
    Site site;
    site.properties = {{"grade", "%", Scale::linear, Kind::continuous, {}},
                       {"rock", "", Scale::linear, Kind::categorical, {"a", "b"}}};
    site.boreholes = {{"H", {0, 0, 0}, {{0, 0, 0}, {0, 0, -100}}, {0, 100}}};
    site.samples.values.resize(2);
    for (const auto& [from, to, grade, rock] : intervals) {
        site.samples.positions.push_back({0, 0, -0.5 * (from + to)});
        site.samples.borehole.push_back(0);
        site.samples.depth.push_back(0.5 * (from + to));
        site.samples.length.push_back(to - from);
        site.samples.values[0].push_back(grade);
        site.samples.values[1].push_back(rock);
    }
    return site;
}

}  // namespace

TEST_CASE("Composites weigh intervals by the length they share, and split long ones") {
    Site site = site_of({{0, 1, 2, 0}, {1, 3, 5, 0}, {3, 7, 1, 1}, {7, 10, 4, 1}});
    const CompositeReport report = composite(site, 5);
    CHECK(report.intervals == 4);
    CHECK(report.composites == 2);
    REQUIRE(site.samples.size() == 2);
    CHECK(site.samples.values[0][0] == Approx((1 * 2 + 2 * 5 + 2 * 1) / 5.0));
    CHECK(site.samples.values[0][1] == Approx((2 * 1 + 3 * 4) / 5.0));
    CHECK(site.samples.values[1] == std::vector<double>{0, 1});
    CHECK(site.samples.positions[1] == Vec3{0, 0, -7.5});
    CHECK(site.samples.length == std::vector<double>{5, 5});
    CHECK(site.samples.depth == std::vector<double>{2.5, 7.5});
}

TEST_CASE("Composites do not bridge gaps, and keep a part where half of it is covered") {
    // 0 to 5: covered to 2 of 5; 5 to 10: to 3; 10 to 15: nothing; the hole ends at 17: 15 to 17 is whole.
    Site site = site_of({{0, 2, 1, 0}, {7, 10, 3, missing}, {15, 17, 9, 1}});
    const CompositeReport report = composite(site, 5);
    REQUIRE(site.samples.size() == 2);
    CHECK(report.dropped == 2);  // grade and rock of the first
    CHECK(site.samples.values[0] == std::vector<double>{3, 9});
    CHECK(std::isnan(site.samples.values[1][0]));
    CHECK(site.samples.depth == std::vector<double>{7.5, 16});
    CHECK(site.samples.length == std::vector<double>{5, 2});
}

TEST_CASE("Equal values composite to themselves bit for bit; points and loose samples stay") {
    Site site = site_of({{0, 0.7, 0.1, 0}, {0.7, 1.9, 0.1, 0}, {1.9, 4, 0.1, 1}});
    site.properties[0].scale = Scale::log10;
    auto& samples = site.samples;
    for (const std::int32_t hole : {0, -1}) {
        samples.positions.push_back({1, 2, 3});
        samples.borehole.push_back(hole);
        samples.depth.push_back(hole < 0 ? missing : 50);
        samples.length.push_back(0);
        samples.values[0].push_back(7);
        samples.values[1].push_back(missing);
    }
    composite(site, 2);
    REQUIRE(samples.size() == 4);
    CHECK(samples.values[0] == std::vector<double>{0.1, 0.1, 7, 7});
    CHECK(samples.borehole == std::vector<std::int32_t>{0, 0, 0, -1});
}

TEST_CASE("A composite with a censored part is censored, and nothing else is") {
    // 0–5: "<1" and a measurement; 5–10: a measurement; 10–15: "<" and ">"; 15–20: "<", but too little of it.
    Site site =
        site_of({{0, 2, 1, 0}, {2, 10, 3, 0}, {10, 12, 1, 0}, {12, 15, 9, 0}, {15, 16, 1, 0}, {16, 20, missing, 0}});
    for (const std::size_t i : {0, 2, 4}) {
        site.samples.set_censoring(0, i, Censoring::below);
    }
    site.samples.set_censoring(0, 3, Censoring::above);
    composite(site, 5);
    REQUIRE(site.samples.size() == 4);
    CHECK(site.samples.values[0][0] == Approx((2 * 1 + 3 * 3) / 5.0));  // the bound counts as it is
    CHECK(std::isnan(site.samples.values[0][3]));
    CHECK(site.samples.censored[0] == std::vector{Censoring::below, Censoring::none, Censoring::both, Censoring::none});
    CHECK(site.samples.censored_count(1) == 0);
}

TEST_CASE("Composites keep the metal: lengths times values add up where all is covered") {
    Random random(91);
    std::vector<std::array<double, 4>> intervals;
    double depth = 0;
    double metal = 0;
    while (depth < 90) {
        const double to = std::min(depth + random(0.3, 4), 90.0);
        intervals.push_back({depth, to, random(0, 5), 0});
        metal += (to - depth) * intervals.back()[2];
        depth = to;
    }
    Site site = site_of(intervals);
    composite(site, 3);
    CHECK(site.samples.size() == 30);
    double kept = 0;
    for (std::size_t i = 0; i < site.samples.size(); ++i) {
        kept += site.samples.length[i] * site.samples.values[0][i];
    }
    CHECK(kept == Approx(metal).epsilon(1e-12));
}
