// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
// How often the truth lies within what is stated, at boreholes that were held back.
#include "interp/plan/uncertainty.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "estimation.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/estimator_plan.hpp"
#include "interp/plan/folds.hpp"
#include "interp/plan/local_error.hpp"
#include "random_field.hpp"
#include "sites.hpp"
#include "tess/property.hpp"
#include "tess/value_source.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

using Truth = std::function<double(const Vec3&)>;

Model wells(std::size_t count, const Truth& truth, std::uint64_t seed) {
    Model model;
    model.properties = {{"v", "", Scale::linear, Kind::continuous, {}}};
    model.samples.positions = borehole_sites(count, 25, seed);
    model.samples.values.resize(1);
    Random random(seed + 1);
    for (std::size_t i = 0; i < model.samples.positions.size(); ++i) {
        model.samples.borehole.push_back(static_cast<std::int32_t>(i / 25));
        model.samples.values[0].push_back(truth(model.samples.positions[i]));
    }
    return model;
}

struct Told {
    double estimate, error, deviation, half_width;
};

/// Estimates at every fifth well, of which nothing is known.
std::vector<Told> held_back(const Model& all, const std::string& spec, Calibration* calibration = nullptr) {
    Model known = all;
    std::vector<ValueQuery> queries;
    std::vector<double> truth;
    for (std::size_t i = 0; i < all.samples.size(); ++i) {
        if (all.samples.borehole[i] % 5 == 0) {
            queries.push_back({all.samples.positions[i], -1, 0});
            truth.push_back(all.samples.values[0][i]);
            known.samples.values[0][i] = missing;
        }
    }
    const ModelEstimator estimator(known, no_faults(), parse_estimator(spec), {}, {.uncertainty = true});
    const auto e = estimator.estimates(queries)[0];
    if (calibration != nullptr) {
        *calibration = e.calibration;
    }
    std::vector<Told> told;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        told.push_back({e.value[i], e.value[i] - truth[i], e.deviation[i], e.half_width[i]});
    }
    return told;
}

struct Cover {
    double one = 0, half_width = 0;
    explicit Cover(const std::vector<Told>& told) {
        for (const Told& t : told) {
            one += std::abs(t.error) <= t.deviation ? 1.0 / double(told.size()) : 0;
            half_width += std::abs(t.error) <= t.half_width ? 1.0 / double(told.size()) : 0;
        }
    }
};

/// Of several fields, since the wells held back of one are few.
Cover cover(std::size_t count, const std::string& spec, const std::function<Truth(std::uint64_t)>& field,
            const std::function<void(std::vector<Told>&)>& choose = {}) {
    std::vector<Told> all;
    for (const std::uint64_t seed : {201, 211, 221, 231}) {
        auto told = held_back(wells(count, field(seed), seed), spec);
        if (choose) {
            choose(told);
        }
        all.insert(all.end(), told.begin(), told.end());
    }
    return Cover(all);
}

Truth stationary(std::uint64_t seed) {
    return RandomField(250, 80, seed + 5);
}

Truth with_trend(std::uint64_t seed) {
    return [field = RandomField(250, 80, seed + 5)](const Vec3& p) { return field(p) + p.x / 60 - p.z / 40; };
}

Truth proportional(std::uint64_t seed) {
    return [field = RandomField(250, 80, seed + 5)](const Vec3& p) { return std::exp(field(p)); };
}

}  // namespace

TEST_CASE("Of truths held back 68 % lie within a standard deviation and 95 % within the half-width") {
    for (const std::string spec : {"natural", "idw", "kriging"}) {
        const Cover c = cover(70, spec, stationary);
        INFO(spec << ": " << c.one << " " << c.half_width);
        CHECK(c.one == Approx(0.69).margin(0.07));
        CHECK(c.half_width == Approx(0.95).margin(0.04));
    }
}

TEST_CASE("The same where there is a trend, which kriging detects") {
    for (const std::string spec : {"natural", "idw", "kriging"}) {
        const Cover c = cover(70, spec, with_trend);
        INFO(spec << ": " << c.one << " " << c.half_width);
        CHECK(c.one == Approx(0.69).margin(0.07));
        CHECK(c.half_width == Approx(0.95).margin(0.04));
    }
    const auto drift = [](const Truth& truth, const std::string& spec) {
        const ModelEstimator fitted(wells(70, truth, 201), no_faults(), parse_estimator(spec));
        return fitted.plan().general.options.at("drift");
    };
    CHECK(drift(with_trend(201), "kriging") == "linear");
    CHECK(drift(with_trend(201), "kriging:drift=constant") == "constant");
    CHECK(drift(stationary(201), "kriging") == "constant");
}

TEST_CASE("The same among the tenth estimated richest, where errors grow with the level") {
    for (const std::string spec : {"natural", "idw", "kriging"}) {
        const Cover all = cover(70, spec, proportional);
        const Cover richest = cover(70, spec, proportional, [](std::vector<Told>& told) {
            std::sort(told.begin(), told.end(), [](const Told& a, const Told& b) { return a.estimate > b.estimate; });
            told.resize(told.size() / 10);
        });
        INFO(spec << ": " << all.one << " " << all.half_width << ", richest " << richest.one << " "
                  << richest.half_width);
        CHECK(all.one == Approx(0.69).margin(0.07));
        CHECK(all.half_width == Approx(0.95).margin(0.04));
        CHECK(richest.one == Approx(0.69).margin(0.15));
        CHECK(richest.half_width > 0.88);
    }
}

TEST_CASE("With few boreholes at least 68 and 95 %") {
    for (const std::string spec : {"natural", "idw", "kriging"}) {
        for (const std::size_t count : {5, 10, 15}) {
            const Cover c = cover(count, spec, stationary);
            INFO(spec << " of " << count << ": " << c.one << " " << c.half_width);
            CHECK(c.one > 0.68);
            CHECK(c.half_width > 0.95);
        }
    }
}

TEST_CASE("Factors found are kept with the estimator and taken up again; other estimators find their own") {
    const Model model = wells(30, stationary(201), 201);
    const auto queries = queries_in({{0, 0, 0}, {side, side, side}}, 300, 202);
    for (const std::string spec : {"idw", "kriging"}) {
        const ModelEstimator found(model, no_faults(), parse_estimator(spec), {}, {.uncertainty = true});
        const auto first = found.estimates(queries)[0];
        const EstimatorPlan stored = parse_estimator_plan(found.plan().to_string());
        REQUIRE(stored.calibrations.contains("v"));
        const ModelEstimator again(model, no_faults(), stored, {}, {.uncertainty = true});
        const auto second = again.estimates(queries)[0];
        CHECK(same_bits(first.deviation, second.deviation));
        CHECK(same_bits(first.half_width, second.half_width));
        CHECK(again.plan().to_string() == found.plan().to_string());
        // What is stored decides, also where it would not be found today.
        EstimatorPlan edited = stored;
        edited.calibrations["v"].factor_sd *= 2;
        const auto doubled =
            ModelEstimator(model, no_faults(), edited, {}, {.uncertainty = true}).estimates(queries)[0];
        for (std::size_t i = 0; i < queries.size(); ++i) {
            REQUIRE(doubled.deviation[i] == Approx(2 * first.deviation[i]));
            REQUIRE(doubled.half_width[i] == first.half_width[i]);
        }
        // A plan without factors, as models had before: they are found there and then, and a variogram that was fitted
        // is fitted anew where boreholes are left out.
        EstimatorPlan older = stored;
        older.calibrations.clear();
        const auto anew = ModelEstimator(model, no_faults(), older, {}, {.uncertainty = true}).estimates(queries)[0];
        CHECK(same_bits(first.deviation, anew.deviation));
    }
    CHECK_FALSE(ModelEstimator(model, no_faults(), parse_estimator("idw")).plan().calibrations.contains("v"));
}

TEST_CASE("Of many samples some five thousand are judged, as many of each borehole") {
    const Model model = wells(240, stationary(201), 201);  // 25 samples each
    const ModelEstimator found(model, no_faults(), parse_estimator("idw"), {}, {.uncertainty = true});
    const Calibration& calibration = found.plan().calibrations.at("v");
    CHECK(calibration.boreholes == 240);
    CHECK(calibration.samples == Approx(5000).epsilon(0.01));
    for (const std::size_t wanted : {4000, 500, 75}) {
        const SomeSites some(40'000, wanted);
        std::vector<std::size_t> of_hole(500, 0);
        for (std::uint32_t i = 0; i < 40'000; ++i) {
            of_hole[i / 80] += some.contains(i) ? 1 : 0;
        }
        const auto [least, most] = std::minmax_element(of_hole.begin(), of_hole.end());
        CHECK(*most - *least <= 4);  // drawn by lot it would be some 16
    }
}

TEST_CASE("Rates of all folds but one have not seen that fold's errors; those of all have") {
    const auto sites = borehole_sites(10, 25, 203);
    std::vector<std::uint32_t> fold_of(sites.size());
    for (std::size_t i = 0; i < sites.size(); ++i) {
        fold_of[i] = static_cast<std::uint32_t>(i / 25);
    }
    const std::vector<double> values(sites.size(), 0);
    const auto learnt = [&](double of_fold_3) {
        LocalError local(sites, values, fold_of);
        Random random(204);
        for (std::uint32_t i = 0; i < sites.size(); ++i) {
            Weights nearest_other;
            nearest_other.terms.push_back({(i + 25) % 250, 1.0});
            const double error = random(-1, 1);
            local.add(i, fold_of[i] == 3 ? of_fold_3 * error : error, nearest_other);
        }
        local.pool(nullptr);
        return std::pair(local.without(3), local.without(4));
    };
    const auto usual = learnt(1);
    const auto wild = learnt(1000);
    CHECK(same_bits(usual.first.near, wild.first.near));
    CHECK(same_bits(usual.first.variance, wild.first.variance));
    CHECK_FALSE(same_bits(usual.second.near, wild.second.near));
    CHECK(std::is_sorted(wild.second.variance.begin(), wild.second.variance.end()));
}
