// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>

#include "tess/model/density_edition.hpp"
#include "tess/property.hpp"
#include "tests/support.hpp"

using namespace terratet;

namespace {

/// Samples along slightly crooked holes, with some loose ones.
Samples random_samples(testing::Random& random, int holes, int records, int loose) {
    Samples samples;
    samples.values.resize(1);
    const auto add = [&](const Vec3& p, std::int32_t hole, double depth) {
        samples.positions.push_back(p);
        samples.borehole.push_back(hole);
        samples.depth.push_back(depth);
        samples.length.push_back(0);
        samples.values[0].push_back(random());
    };
    for (std::int32_t hole = 0; hole < holes; ++hole) {
        Vec3 p = random.in({{0, 0, 0}, {300, 300, 0}});
        for (int i = 0; i < records; ++i) {
            p = p + Vec3{random(-0.5, 0.5), random(-0.5, 0.5), -2.6};
            add(p, hole, 2.6 * i);
        }
    }
    for (int i = 0; i < loose; ++i) {
        add(random.in({{0, 0, -300}, {300, 300, 0}}), -1, missing);
    }
    return selected(samples, canonical_order(samples));
}

double nearest(const std::vector<Vec3>& points, const Vec3& p, double at_least = 0) {
    double best = 1e300;
    for (const Vec3& q : points) {
        const double d = distance(p, q);
        best = d > at_least || (at_least == 0 && q != p) ? std::min(best, d) : best;
    }
    return best;
}

std::vector<Vec3> places(const Samples& samples, const std::vector<std::uint32_t>& indices) {
    return selected(samples, indices).positions;
}

/// A square fault through the middle, as two triangles.
std::vector<Barrier> one_fault() {
    Barrier fault;
    fault.sheet.vertices = {{50, 50, -150}, {250, 50, -150}, {250, 250, -150}, {50, 250, -150}};
    fault.sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    fault.protection_radius = 15;
    return {fault};
}

}  // namespace

TEST_CASE("D1: no two kept samples are closer than l_min") {
    testing::Random random(11);
    for (int round = 0; round < 40; ++round) {
        const Samples samples = random_samples(random, 1 + round % 6, 100, 50 * (round % 3));
        for (const DensityMode mode : {DensityMode::canonical, DensityMode::paper}) {
            const double l_min = random(3, 40);
            const std::vector<Barrier> none;
            const auto result = edit_density(samples, l_min, mode, BarrierQuery(none));
            const auto kept = places(samples, result.kept);
            REQUIRE(!kept.empty());
            for (const Vec3& p : kept) {
                REQUIRE(nearest(kept, p) >= l_min);
            }
        }
    }
}

TEST_CASE("D2: every dropped sample has a kept one within l_min, or lies in a fault's protection zone") {
    testing::Random random(12);
    const auto faults = one_fault();
    const BarrierQuery proximity(faults);
    for (int round = 0; round < 40; ++round) {
        const Samples samples = random_samples(random, 1 + round % 6, 100, 40);
        for (const DensityMode mode : {DensityMode::canonical, DensityMode::paper}) {
            const double l_min = random(3, 40);
            const auto result = edit_density(samples, l_min, mode, proximity);
            const auto kept = places(samples, result.kept);
            CHECK(result.kept.size() + result.deleted + result.near_faults.size() == samples.size());
            for (std::uint32_t i = 0; i < samples.size(); ++i) {
                const Vec3& p = samples.positions[i];
                const bool in_zone = p.z > -165 && p.z < -135 && p.x > 35 && p.x < 265 && p.y > 35 && p.y < 265;
                const bool is_kept = std::ranges::binary_search(result.kept, i);
                REQUIRE((is_kept || in_zone || nearest(kept, p) < l_min));
            }
            for (const std::uint32_t i : result.near_faults) {
                REQUIRE(std::abs(samples.positions[i].z + 150) < 15);
            }
        }
    }
}

TEST_CASE("D3: density edition does not depend on the order of the input") {
    testing::Random random(13);
    const auto faults = one_fault();
    const BarrierQuery proximity(faults);
    for (int round = 0; round < 20; ++round) {
        Samples samples = random_samples(random, 4, 80, 30);
        std::vector<std::uint32_t> shuffled(samples.size());
        for (std::uint32_t i = 0; i < shuffled.size(); ++i) {
            shuffled[i] = i;
        }
        for (std::size_t i = shuffled.size(); i > 1; --i) {
            std::swap(shuffled[i - 1], shuffled[random.below(i)]);
        }
        const Samples other = selected(samples, shuffled);
        const Samples restored = selected(other, canonical_order(other));
        for (const DensityMode mode : {DensityMode::canonical, DensityMode::paper}) {
            CHECK(places(samples, edit_density(samples, 20, mode, proximity).kept) ==
                  places(restored, edit_density(restored, 20, mode, proximity).kept));
        }
    }
}

TEST_CASE("The canonical order keeps what fits along a hole; the paper's rule does not stay at its literal few") {
    Samples hole;
    hole.values.resize(1);
    for (int i = 0; i < 323; ++i) {
        hole.positions.push_back({0, 0, -2.6 * i});
        hole.borehole.push_back(0);
        hole.depth.push_back(2.6 * i);
        hole.length.push_back(0);
        hole.values[0].push_back(i);
    }
    const std::vector<Barrier> none;
    const BarrierQuery no_faults(none);
    CHECK(edit_density(hole, 20, DensityMode::canonical, no_faults).kept.size() == 41);  // one in eight: 20.8 apart
    const auto by_paper = edit_density(hole, 20, DensityMode::paper, no_faults).kept.size();
    CHECK(by_paper >= 28);
    CHECK(by_paper <= 42);
}

TEST_CASE("Coincident samples merge into their mean, in the property's scale, censored if one of them is") {
    Samples samples;
    samples.positions = {{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {1, 2, 3}};
    samples.borehole = {0, 0, 1, 1};
    samples.depth = {0, 1, 2, 3};
    samples.length = {0, 0, 0, 0};
    samples.values = {{1e-12, 5, 1e-8, missing}, {2, 0, 1, 1}, {7, 0, 7, 7}};
    const std::vector properties{parse_property("K:log10"), parse_property("L:categorical"), parse_property("T")};
    samples.set_censoring(0, 2, Censoring::below);
    samples.set_censoring(2, 1, Censoring::above);
    CHECK(merge_coincident(samples, properties).merged == 2);
    REQUIRE(samples.size() == 2);
    CHECK(samples.values[0][0] == Approx(1e-10));
    CHECK(samples.values[1][0] == 1);
    CHECK(samples.values[2][0] == 7);
    CHECK(samples.positions[1] == Vec3{0, 0, 0});
    CHECK(samples.censored[0] == std::vector{Censoring::below, Censoring::none});  // the mean of a bound and a value
    CHECK(samples.censored[2] == std::vector{Censoring::none, Censoring::above});
}
