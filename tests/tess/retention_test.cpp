// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tess/model/density_edition.hpp"
#include "tess/model/retention.hpp"
#include "tess/model/tolerance.hpp"
#include "tests/support.hpp"

using namespace terratet;

namespace {

const Domain nowhere;  // only overrides ask for it

/// A straight hole of `count` samples a metre apart.
void add_hole(Samples& samples, const Vec3& collar, std::int32_t hole, int count, double (*value)(const Vec3&)) {
    samples.values.resize(1);
    for (int i = 0; i < count; ++i) {
        const Vec3 p = collar - Vec3{0, 0, 1.0 * i};
        samples.positions.push_back(p);
        samples.borehole.push_back(hole);
        samples.depth.push_back(i);
        samples.length.push_back(0);
        samples.values[0].push_back(value(p));
    }
}

double wavy(const Vec3& p) {
    return std::sin(p.z / 7) + 0.01 * p.x + (std::abs(p.z + 30) < 1.2 ? 5 : 0);
}

struct Kept {
    Retention retention;
    std::vector<std::uint32_t> samples;
};

Kept kept_of(const Samples& samples, double tolerance, double l_min) {
    Criteria criteria;
    criteria.l_min = l_min;
    ResolutionField field(criteria, nowhere, {});
    const std::vector<std::uint32_t> candidates = unprotected(samples, BarrierQuery({}));
    const std::vector<Property> properties{{"P", "", Scale::linear, Kind::continuous, {}, false}};
    const double limit[] = {tolerance};
    Kept result{retain(samples, properties, limit, candidates, field, 1e-3), {}};
    criteria.fine = result.retention.fine;
    result.samples =
        edit_density(samples, ResolutionField(criteria, nowhere, {}), DensityMode::canonical, BarrierQuery({})).kept;
    return result;
}

/// What linear interpolation between kept samples of the hole makes of sample i, straight from the definition.
double along(const Samples& samples, const std::vector<std::uint32_t>& kept, std::uint32_t i) {
    std::optional<std::uint32_t> above;
    std::optional<std::uint32_t> below;
    for (const std::uint32_t k : kept) {
        if (samples.borehole[k] == samples.borehole[i]) {
            if (samples.depth[k] <= samples.depth[i] && (!above || samples.depth[k] > samples.depth[*above])) {
                above = k;
            }
            if (samples.depth[k] >= samples.depth[i] && (!below || samples.depth[k] < samples.depth[*below])) {
                below = k;
            }
        }
    }
    const double a = samples.values[0][above ? *above : *below];
    const double b = samples.values[0][below ? *below : *above];
    if (!above || !below || *above == *below) {
        return a;
    }
    const double t = (samples.depth[i] - samples.depth[*above]) / (samples.depth[*below] - samples.depth[*above]);
    return a + t * (b - a);
}

}  // namespace

TEST_CASE("T2: linear interpolation between kept samples meets all dropped ones within the tolerance") {
    Samples samples;
    for (std::int32_t hole = 0; hole < 9; ++hole) {
        add_hole(samples, {100.0 * (hole % 3), 100.0 * (hole / 3), 0}, hole, 120, wavy);  // NOLINT
    }
    std::size_t fewer = samples.size() + 1;
    for (const double tolerance : {0.05, 0.2, 0.6}) {
        const Kept kept = kept_of(samples, tolerance, 25);
        for (std::uint32_t i = 0; i < samples.size(); ++i) {
            CHECK(std::abs(along(samples, kept.samples, i) - samples.values[0][i]) <= tolerance);
        }
        CHECK(kept.samples.size() < fewer);
        CHECK(kept.samples.size() < samples.size() / 2);
        fewer = kept.samples.size();
        CHECK(kept.retention.agreement[0].r2 > 1 - tolerance * tolerance);
    }
}

TEST_CASE("A trend along straight holes keeps no more samples than l_min does") {
    Samples samples;
    for (std::int32_t hole = 0; hole < 4; ++hole) {
        add_hole(samples, {100.0 * hole, 0, 0}, hole, 101, [](const Vec3& p) { return 0.5 * p.z + p.x; });
    }
    const Kept kept = kept_of(samples, 0.1, 25);
    CHECK(kept.retention.fine.empty());
    CHECK(kept.samples.size() == 4 * 5);
}

TEST_CASE("A seam thinner than l_min stays, also one that only loose samples know") {
    Samples samples;
    add_hole(samples, {0, 0, 0}, 0, 100, wavy);
    add_hole(samples, {50, 0, 0}, 1, 100, [](const Vec3&) { return 0.0; });
    testing::Random random(3);
    for (int i = 0; i < 600; ++i) {
        const Vec3 p = random.in({{200, 0, -100}, {300, 100, 0}});
        samples.positions.push_back(p);
        samples.borehole.push_back(-1);
        samples.depth.push_back(missing);
        samples.length.push_back(0);
        samples.values[0].push_back(std::abs(p.z + 50) < 5 ? 10 : 0);
    }
    samples = selected(samples, canonical_order(samples));
    const Kept kept = kept_of(samples, 0.5, 40);
    std::size_t rich = 0;
    std::size_t rich_kept = 0;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        const bool is_rich = samples.values[0][i] > 4;
        rich += is_rich ? 1 : 0;
        rich_kept += is_rich && std::ranges::binary_search(kept.samples, i) ? 1 : 0;
    }
    CHECK(rich > 50);
    CHECK(rich_kept > rich * 3 / 5);  // others lie between rich ones
    CHECK(kept.retention.agreement[0].r2 > 0.99);
    const Kept coarse = kept_of(samples, 1e9, 40);
    CHECK(coarse.retention.agreement[0].r2 < 0.5);
}

TEST_CASE("D1: with fine places no two kept samples are nearer than the smaller of their l_min") {
    Samples samples;
    for (std::int32_t hole = 0; hole < 5; ++hole) {
        add_hole(samples, {7.0 * hole, 3.0 * hole, 0}, hole, 120, wavy);
    }
    const Kept kept = kept_of(samples, 0.1, 30);
    const auto l_min = [&](const Vec3& p) {  // brute force
        double least = 30;
        for (const FinePlace& place : kept.retention.fine) {
            least = std::min(least, place.l_min + 0.4 * distance(place.position, p));
        }
        return least;
    };
    for (const std::uint32_t i : kept.samples) {
        for (const std::uint32_t k : kept.samples) {
            const Vec3& p = samples.positions[i];
            const Vec3& q = samples.positions[k];
            CHECK((i == k || distance(p, q) >= std::min(l_min(p), l_min(q)) * (1 - 1e-12)));
        }
    }
    CHECK(kept.samples.size() > 100);
}

TEST_CASE("Graded sizes are the least of size and 0.4 of the distance, by brute force") {
    testing::Random random(5);
    std::vector<FinePlace> places;
    for (int i = 0; i < 700; ++i) {
        places.push_back({random.in({{0, 0, 0}, {100, 100, 20}}), random(0.1, 9)});
    }
    const GradedSizes all(places);
    const std::vector<FinePlace> needed = without_implied(places);
    const GradedSizes some(needed);
    CHECK(needed.size() < places.size());
    for (int i = 0; i < 500; ++i) {
        const Vec3 p = random.in({{-20, -20, -20}, {120, 120, 40}});
        double least = 7;
        for (const FinePlace& place : places) {
            least = std::min(least, place.l_min + 0.4 * distance(place.position, p));
        }
        CHECK(all.at(p, 7) == least);
        CHECK(some.at(p, 7) == least);
    }
}

TEST_CASE("A tolerance in percent is of the middle range, but at least a hundredth of nearly all of it") {
    const Property property{"P", "", Scale::linear, Kind::continuous, {}, false};
    std::vector<double> values;
    for (int i = 0; i <= 1000; ++i) {
        values.push_back(i);
    }
    CHECK(tolerance_of_range(property, values, 10) == Approx(90));
    values.assign(1000, 1);
    for (int i = 0; i < 20; ++i) {
        values[static_cast<std::size_t>(i)] = 101;
    }
    CHECK(tolerance_of_range(property, values, 10) == Approx(1));
    CHECK(tolerance_of_range({"C", "", Scale::linear, Kind::categorical, {}, false}, values, 10) == 0);
}
