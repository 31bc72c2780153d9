// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/model_source.hpp"
#include "interp/estimator_spec.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "estimation.hpp"
#include "sites.hpp"
#include "tess/barrier_query.hpp"
#include "tess/property.hpp"
#include "tess/value_source.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

/// Columns: linear (everywhere), log10 (everywhere, one value not positive), category (every third sample), missing
/// altogether.
Model model_of(const std::vector<Vec3>& sites) {
    Model model;
    model.properties = {{"linear", "", Scale::linear, Kind::continuous, {}},
                        {"log", "", Scale::log10, Kind::continuous, {}},
                        {"rock", "", Scale::linear, Kind::categorical, {"clay", "gneiss", "granite"}},
                        {"nothing", "", Scale::linear, Kind::continuous, {}}};
    model.samples.positions = sites;
    model.samples.borehole.assign(model.samples.size(), -1);
    model.samples.values.assign(4, std::vector<double>(sites.size(), missing));
    for (std::size_t i = 0; i < sites.size(); ++i) {
        const Vec3& p = sites[i];
        model.samples.values[0][i] = 3 + 0.01 * p.x - 0.02 * p.y + 0.005 * p.z;
        model.samples.values[1][i] = i == 5 ? -1 : std::pow(10, 1 + 0.002 * p.x);
        if (i % 3 == 0) {
            model.samples.values[2][i] = p.x < 500 ? 0 : 2;
        }
    }
    return model;
}

}  // namespace

TEST_CASE("A model's source estimates each property from the samples that have it, in its scale") {
    const auto sites = uniform_sites(3000, 1);
    const Model model = model_of(sites);
    const auto source = make_model_source(model, no_faults(), {});
    const auto queries = queries_in({{200, 200, 200}, {800, 800, 800}}, 300, 2);
    const auto batch = source(queries);
    REQUIRE(batch.values.size() == 4);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const Vec3& q = queries[i].position;
        REQUIRE(batch.values[0][i] == Approx(3 + 0.01 * q.x - 0.02 * q.y + 0.005 * q.z).epsilon(1e-10));
        REQUIRE(std::log10(batch.values[1][i]) == Approx(1 + 0.002 * q.x).epsilon(1e-10));
        REQUIRE((batch.values[2][i] == 0 || batch.values[2][i] == 2));
        if (std::abs(q.x - 500) > 200) {
            REQUIRE(batch.values[2][i] == (q.x < 500 ? 0 : 2));
        }
        REQUIRE(std::isnan(batch.values[3][i]));
        REQUIRE((batch.extrapolation[i] > 0 && batch.extrapolation[i] < 0.5));
    }
}

TEST_CASE("On a sample its measured value comes back, bit for bit") {
    const auto sites = uniform_sites(500, 3);
    const Model model = model_of(sites);
    for (const std::string spec : {"natural", "idw", "nearest"}) {
        const auto source = make_model_source(model, no_faults(), parse_estimator(spec));
        std::vector<ValueQuery> queries;
        for (const Vec3& p : sites) {
            queries.push_back({p});
        }
        const auto batch = source(queries);
        for (std::size_t i = 0; i < sites.size(); ++i) {
            REQUIRE(batch.values[0][i] == model.samples.values[0][i]);
            if (i != 5) {
                REQUIRE(batch.values[1][i] == model.samples.values[1][i]);
            }
            if (i % 3 == 0) {
                REQUIRE(batch.values[2][i] == model.samples.values[2][i]);
            }
        }
        CHECK(batch.values[1][5] > 0);  // a value without a logarithm does not count as measured
    }
}

TEST_CASE("A category is the class of the largest weight, the smaller index when two weigh the same") {
    Model model;
    model.properties = {{"rock", "", Scale::linear, Kind::categorical, {"a", "b", "c"}}};
    model.samples.positions = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
    model.samples.borehole.assign(model.samples.size(), -1);
    const auto source_of = [&](std::vector<double> classes) {
        model.samples.values = {std::move(classes)};
        return make_model_source(model, no_faults(),
                                 parse_estimator("idw:power=1"))(std::vector<ValueQuery>{{{0, 0, 0}}, {{0.5, 0, 0}}});
    };
    CHECK(source_of({2, 1, 2, 1}).values[0] == std::vector<double>{1, 1});
    CHECK(source_of({1, 2, 1, 2}).values[0] == std::vector<double>{1, 2});
    CHECK(source_of({0, 2, 0, 0}).values[0] == std::vector<double>{0, 0});
}

TEST_CASE("R6: a source gives the same bits one by one and in a batch, at any thread count") {
    const auto sites = borehole_sites(20, 50, 4);
    const Model model = model_of(sites);
    const auto counters = std::make_shared<EstimatorCounters>();
    const auto source = make_model_source(model, no_faults(), {}, counters);
    const auto queries = queries_in({{-200, -200, -200}, {1200, 1200, 1200}}, 9000, 5);
    const auto batch = source(queries);
    CHECK(counters->queries == queries.size());
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const auto serial = source(queries);
        for (std::size_t p = 0; p < 4; ++p) {
            REQUIRE(same_bits(batch.values[p], serial.values[p]));
        }
        REQUIRE(same_bits(batch.extrapolation, serial.extrapolation));
    }
    for (std::size_t i = 0; i < queries.size(); i += 7) {
        const auto single = source(std::span(queries).subspan(i, 1));
        for (std::size_t p = 0; p < 4; ++p) {
            REQUIRE(same_bits({batch.values[p][i]}, single.values[p]));
        }
        REQUIRE(batch.extrapolation[i] == single.extrapolation[0]);
    }
    CHECK(counters->fallbacks < counters->queries / 1000);
}

TEST_CASE("E1: with 0 on one side of a fault and 1 on the other every estimate is 0 or 1") {
    const std::vector<Barrier> faults = {fault_at_x(500, -1e4, 1e4)};
    const BarrierQuery proximity(faults);
    Model model;
    model.properties = {{"side", "", Scale::linear, Kind::continuous, {}}};
    model.samples.positions = uniform_sites(800, 6);
    model.samples.borehole.assign(model.samples.size(), -1);
    model.samples.values.resize(1);
    for (const Vec3& p : model.samples.positions) {
        model.samples.values[0].push_back(p.x > 500 ? 1 : 0);
    }
    const auto queries = queries_in({{300, -100, -100}, {700, 1100, 1100}}, 5000, 7);
    for (const std::string spec : {"natural", "idw", "nearest"}) {
        const auto batch = make_model_source(model, proximity, parse_estimator(spec))(queries);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            REQUIRE(std::abs(batch.values[0][i] - (queries[i].position.x > 500 ? 1 : 0)) <= 1e-12);
        }
    }
}

TEST_CASE("Estimates between values stay within them") {
    Model model;
    model.properties = {{"noise", "", Scale::linear, Kind::continuous, {}}};
    model.samples.positions = uniform_sites(2000, 8);
    model.samples.borehole.assign(model.samples.size(), -1);
    Random random(9);
    model.samples.values = {std::vector<double>(2000)};
    for (double& value : model.samples.values[0]) {
        value = random(-5, 7);
    }
    const auto batch =
        make_model_source(model, no_faults(), {})(queries_in({{-500, 0, 0}, {1500, 1000, 1000}}, 5000, 10));
    for (const double value : batch.values[0]) {
        REQUIRE(value >= -5 - 1e-12);
        REQUIRE(value <= 7 + 1e-12);
    }
}
