// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/extrapolation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "estimation.hpp"
#include "interp/estimator_plan.hpp"
#include "interp/model_estimator.hpp"
#include "sites.hpp"
#include "tess/barrier_query.hpp"
#include "tess/error.hpp"
#include "tess/property.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

/// Holes on a square grid, a sample every five metres.
std::vector<Vec3> grid_of_holes(int n, double spacing) {
    std::vector<Vec3> sites;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            for (int k = 0; k < 20; ++k) {
                sites.push_back({i * spacing, j * spacing, -5.0 * k});
            }
        }
    }
    return sites;
}

std::vector<std::int32_t> twenty_a_hole(std::size_t count) {
    std::vector<std::int32_t> holes(count);
    for (std::size_t i = 0; i < count; ++i) {
        holes[i] = static_cast<std::int32_t>(i / 20);
    }
    return holes;
}

}  // namespace

TEST_CASE("The reach is three spacings of holes, known as such or not, or what a variogram says") {
    const auto sites = grid_of_holes(5, 200);
    const auto reach = [&](const std::string& spec, bool loose) {
        return reach_of(parse_estimator(spec), sites,
                        loose ? std::vector<std::int32_t>() : twenty_a_hole(sites.size()));
    };
    for (const bool loose : {false, true}) {
        CHECK(reach("natural", loose) == Approx(600));
        CHECK(reach("idw:ratio2=0.5", loose) >= 600);
        CHECK(reach("kriging:nugget=0:sill=1:range=70:ratio3=1", loose) == Approx(70));
        CHECK(reach("kriging:model=exponential:nugget=0:sill=1:range=70:ratio3=1", loose) == Approx(210).epsilon(0.01));
    }
    CHECK(reach_of(parse_estimator("natural"), lattice_sites(9), {}) == Approx(3));
    const std::vector<Vec3> one_hole(sites.begin(), sites.begin() + 20);
    CHECK(reach_of(parse_estimator("natural"), one_hole, twenty_a_hole(20)) == Approx(0.5 * 95));
    CHECK(reach_of(parse_estimator("natural"), std::vector<Vec3>{{1, 2, 3}}, {}) == 0);
}

TEST_CASE("The extrapolation is the distance to the nearest visible sample over twice the reach, by any estimator") {
    const std::vector<Barrier> faults = {fault_at_x(350, -5000, 5000)};
    const BarrierQuery proximity(faults);
    Model model;
    model.properties = {{"v", "", Scale::linear, Kind::continuous, {}}};
    model.samples.positions = grid_of_holes(4, 200);
    model.samples.borehole = twenty_a_hole(model.samples.size());
    model.samples.values = {std::vector<double>(model.samples.size(), 7.0)};
    model.samples.values[0][3] = 8;
    auto places = places_in({{-2000, -2000, -2000}, {2600, 2600, 2000}}, 1000, 1);
    places.insert(places.end(), model.samples.positions.begin(), model.samples.positions.begin() + 50);
    for (const std::string spec : {"natural", "natural:smooth", "laplace", "linear", "idw", "nearest",
                                   "kriging:nugget=0:sill=1:range=600:ratio3=1"}) {
        CAPTURE(spec);
        const ModelEstimator estimator(model, proximity, parse_estimator(spec));
        const auto batch = estimator.values(queries_at(places));
        const auto estimates = estimator.estimates(queries_at(places))[0];
        for (std::size_t i = 0; i < places.size(); ++i) {
            double nearest = std::numeric_limits<double>::infinity();
            for (const Vec3& p : model.samples.positions) {
                if (p == places[i] || !proximity.crosses_any(places[i], p)) {
                    nearest = std::min(nearest, distance(places[i], p));
                }
            }
            REQUIRE(batch.extrapolation[i] == Approx(std::min(1.0, nearest / 1200)).margin(1e-12));
            REQUIRE(estimates.extrapolation[i] == batch.extrapolation[i]);
        }
        CHECK(batch.extrapolation.back() == 0);
    }
}

namespace {

/// The part y ≤ 500 of the plane x = 500, with free rims all round.
Barrier ending_fault() {
    Barrier fault = fault_at_x(500, -1000, 2000);
    for (Vec3& p : fault.sheet.vertices) {
        p.y = std::min(p.y, 500.0);
    }
    fault.spacing = 50;
    return fault;
}

/// Before the fault, where the places look from behind it, and a few that they see, far away.
Model samples_before_and_far() {
    Model model;
    model.properties = {{"v", "", Scale::linear, Kind::continuous, {}}};
    model.samples.positions = places_in({{200, 100, 300}, {450, 450, 700}}, 60, 2);
    for (const Vec3& p : places_in({{520, 2000, 300}, {700, 2200, 700}}, 8, 3)) {
        model.samples.positions.push_back(p);
    }
    model.samples.borehole.assign(model.samples.size(), -1);
    Random random(4);
    for (std::size_t i = 0; i < model.samples.size(); ++i) {
        model.samples.values.resize(1);
        model.samples.values[0].push_back(random());
    }
    return model;
}

}  // namespace

TEST_CASE("Behind a fault's end the extrapolation is by the shortest way round it") {
    const std::vector<Barrier> faults = {ending_fault()};
    const BarrierQuery proximity(faults);
    const Model model = samples_before_and_far();
    const auto places = places_in({{510, 250, 350}, {700, 490, 650}}, 60, 5);
    for (const std::string spec :
         {"natural", "laplace", "idw", "nearest", "idw:azimuth=30:ratio2=0.6:ratio3=0.4",
          "natural:azimuth=30:ratio2=0.6:ratio3=0.4", "kriging:nugget=0:sill=1:range=900:ratio3=1"}) {
        CAPTURE(spec);
        EstimatorPlan plan = parse_estimator(spec);
        plan.traits["v"] = {0, 1, 900};
        const Metric metric(anisotropy_of(plan.general));
        const auto e = ModelEstimator(model, proximity, plan).values(queries_at(places)).extrapolation;
        std::size_t behind = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            double straight = std::numeric_limits<double>::infinity();
            double shortest = straight;
            for (const Vec3& p : model.samples.positions) {
                const auto way_by = [&](const Vec3& at) {
                    return distance(metric(places[i]), metric(at)) + distance(metric(at), metric(p));
                };
                if (!proximity.crosses_any(places[i], p)) {
                    straight = std::min(straight, distance(metric(places[i]), metric(p)));
                }
                for (double z = 0; z <= 1000; z += 2) {
                    shortest = std::min(shortest, way_by({500, 500, z}));
                }
            }
            shortest = std::min(shortest, straight);
            behind += shortest < 0.7 * straight ? 1 : 0;
            REQUIRE(e[i] >= shortest / 1800 * (1 - 1e-3));  // the oracle turns at places 2 m apart
            REQUIRE(e[i] <= shortest / 1800 * 1.05);
        }
        CHECK(behind > 20);
    }
}

TEST_CASE("Ways turn more than once: round the corner of two faults that meet") {
    // An L in plan, open to the north and east; the samples lie in the far arm's shadow.
    std::vector<Barrier> faults = {fault_at_x(500, -3000, 3000), fault_at_x(500, -3000, 3000)};
    for (Vec3& p : faults[0].sheet.vertices) {
        p.y = p.y < 0 ? 0 : 400;
    }
    for (Vec3& p : faults[1].sheet.vertices) {
        p = {p.y < 0 ? 500.0 : 800.0, 0, p.z};
    }
    const BarrierQuery proximity(faults);
    Model model = samples_before_and_far();
    for (Vec3& p : model.samples.positions) {
        p = p.y < 1000 ? Vec3{p.x, p.y - 700, p.z} : Vec3{p.x + 9000, p.y, p.z};
    }
    EstimatorPlan plan = parse_estimator("nearest");
    plan.traits["v"] = {0, 1, 4000};
    const Vec3 place{510, 20, 500};
    const double e = ModelEstimator(model, proximity, plan).values(queries_at({place})).extrapolation[0];
    double shortest = std::numeric_limits<double>::infinity();
    for (const Vec3& p : model.samples.positions) {
        for (double z = 300; z <= 700; z += 1) {
            shortest = std::min(shortest, distance(place, {800, 0, z}) + distance(Vec3{800, 0, z}, p));
        }
    }
    CHECK(e >= shortest / 8000 * (1 - 1e-3));
    CHECK(e <= shortest / 8000 * 1.03);
}

TEST_CASE("The reach and the values' range stay as they were found when samples come") {
    Model model;
    model.properties = {{"a of\nb\\n", "", Scale::linear, Kind::continuous, {}}};
    model.samples.positions = grid_of_holes(4, 200);
    model.samples.borehole = twenty_a_hole(model.samples.size());
    model.samples.values = {std::vector<double>(model.samples.size(), 7.0)};
    model.samples.values[0][3] = 8;
    const EstimatorPlan found = ModelEstimator(model, no_faults(), parse_estimator("natural")).plan();
    const EstimatorPlan stored = parse_estimator_plan(found.to_string());
    CHECK(stored.to_string() == found.to_string());
    const ColumnTraits& traits = stored.traits.at(model.properties[0].name);
    CHECK(traits.lowest == 7);
    CHECK(traits.highest == 8);
    CHECK(traits.reach == Approx(600));
    // Holes between halve the spacing; one sample is richer than any before.
    for (const Vec3& p : grid_of_holes(3, 200)) {
        model.samples.positions.push_back(p + Vec3{100, 100, 0});
        model.samples.values[0].push_back(20);
    }
    model.samples.borehole = twenty_a_hole(model.samples.size());
    const auto places = queries_at({{-300, 100, -50}});
    const ModelEstimator again(model, no_faults(), stored);
    CHECK(again.plan().to_string() == found.to_string());
    CHECK(again.values(places).extrapolation[0] == Approx(std::hypot(300, 100) / 1200).epsilon(0.01));
    // A model of an older version has none: they are found there and then.
    const ModelEstimator anew(model, no_faults(), parse_estimator_plan("natural"));
    CHECK(anew.plan().traits.begin()->second.highest == 20);
    CHECK(anew.values(places).extrapolation[0] > 0.3);
}

TEST_CASE("A plan with traits that no samples can have is refused") {
    for (const std::string text :
         {"samples:lowest=1:highest=0:reach=5", "samples:lowest=0:highest=1:reach=-5", "samples:lowest=0:highest=1",
          "samples:lowest=0:highest=1:reach=nan", "samples:lowest=0:highest=1:reach=1e999",
          "samples:lowest=0:highest=1:reach=5:more=1", "samples:highest=1:lowest=0:reach=5", "samples:"}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_estimator_plan("natural\n" + text + " of v"), UsageError);
    }
}
