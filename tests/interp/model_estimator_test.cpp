// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/model_estimator.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numeric>

#include "estimation.hpp"
#include "interp/estimator_plan.hpp"
#include "interp/plan/folds.hpp"
#include "interp/plan/uncertainty.hpp"
#include "sites.hpp"
#include "tess/property.hpp"
#include "tess/value_source.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

/// Wells with a smooth grade, its logarithmic twin, and a rock that changes with depth.
Model wells_model(std::size_t wells = 20, std::size_t samples = 25) {
    Model model;
    model.properties = {{"grade", "%", Scale::linear, Kind::continuous, {}},
                        {"K", "m/s", Scale::log10, Kind::continuous, {}},
                        {"rock", "", Scale::linear, Kind::categorical, {"clay", "sand", "till"}},
                        {"nothing", "", Scale::linear, Kind::continuous, {}}};
    model.samples.positions = borehole_sites(wells, samples, 31);
    model.samples.values.resize(4);
    Random random(32);
    for (std::size_t i = 0; i < wells * samples; ++i) {
        const Vec3& p = model.samples.positions[i];
        const double field = std::sin(p.x / 200) + std::cos(p.y / 250) + p.z / 500 + random(-0.1, 0.1);
        model.samples.borehole.push_back(static_cast<std::int32_t>(i / samples));
        model.samples.values[0].push_back(field);
        model.samples.values[1].push_back(std::pow(10, field - 9));
        model.samples.values[2].push_back(p.z > 700 ? 0 : p.z > 300 ? 1 : 2);
        model.samples.values[3].push_back(missing);
    }
    return model;
}

}  // namespace

TEST_CASE("Estimates with everything known about them have the values of the fast way") {
    const Model model = wells_model();
    const auto queries = queries_in({{-100, -100, 0}, {1100, 1100, 1000}}, 6000, 33);
    for (const std::string spec : {"natural", "idw:radius=150", "nearest"}) {
        const ModelEstimator estimator(model, no_faults(), parse_estimator(spec), {}, {.uncertainty = true});
        const ValueBatch fast = estimator.values(queries);
        const auto full = estimator.estimates(queries);
        REQUIRE(full.size() == 4);
        for (std::size_t p = 0; p < 4; ++p) {
            REQUIRE(same_bits(fast.values[p], full[p].value));
        }
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const bool some = !std::isnan(full[0].value[i]);
            REQUIRE((full[0].samples[i] > 0) == some);
            REQUIRE((some || std::isnan(full[0].deviation[i])));
            REQUIRE((!some || spec != "natural" || full[0].deviation[i] >= 0));
            REQUIRE((some || full[0].extrapolation[i] == 1));
            REQUIRE(full[3].samples[i] == 0);
            REQUIRE(std::isnan(full[3].value[i]));
        }
        CHECK(full[0].deviation_source == DeviationSource::cross_validated);
        CHECK(full[2].deviation_source == DeviationSource::none);
    }
}

TEST_CASE("Probabilities of classes sum to 1, the value is the likeliest, the entropy says how sure it is") {
    const Model model = wells_model();
    const auto queries = queries_in({{0, 0, 0}, {1000, 1000, 1000}}, 3000, 34);
    for (const std::string spec :
         {"natural", "idw:max_points=8", "nearest", "kriging:nugget=0:sill=1:range=500:ratio3=1"}) {
        const auto rock = ModelEstimator(model, no_faults(), parse_estimator(spec)).estimates(queries)[2];
        std::size_t uncertain = 0;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            double sum = 0;
            double entropy = 0;
            double largest = 0;
            for (const auto& column : rock.probability) {
                REQUIRE(column[i] >= 0);
                sum += column[i];
                entropy -= column[i] > 0 ? column[i] * std::log2(column[i]) : 0;
                largest = std::max(largest, column[i]);
            }
            REQUIRE(sum == Approx(1).margin(1e-12));
            REQUIRE(rock.entropy[i] == Approx(entropy).margin(1e-12));
            REQUIRE(rock.probability[static_cast<std::size_t>(rock.value[i])][i] == largest);
            uncertain += rock.entropy[i] > 0.1 ? 1 : 0;
        }
        CHECK((uncertain > 0) == (spec != "nearest"));
    }
}

TEST_CASE("A cross-validated deviation is 0 on samples, grows away from them, and covers what it should") {
    Model model = wells_model(40, 25);
    // A quarter of the wells is kept back: truth to compare with.
    Model known = model;
    std::vector<std::uint32_t> kept;
    std::vector<std::uint32_t> back;
    for (std::uint32_t i = 0; i < model.samples.size(); ++i) {
        (model.samples.borehole[i] % 4 == 0 ? back : kept).push_back(i);
    }
    known.samples.values.assign(4, {});
    known.samples.positions.clear();
    known.samples.borehole.clear();
    for (const std::uint32_t i : kept) {
        known.samples.positions.push_back(model.samples.positions[i]);
        known.samples.borehole.push_back(model.samples.borehole[i]);
        for (std::size_t p = 0; p < 4; ++p) {
            known.samples.values[p].push_back(model.samples.values[p][i]);
        }
    }
    for (const std::string spec : {"natural", "idw", "nearest"}) {
        const ModelEstimator estimator(known, no_faults(), parse_estimator(spec), {}, {.uncertainty = true});
        std::vector<ValueQuery> on;
        for (const Vec3& p : known.samples.positions) {
            on.push_back({p});
        }
        const auto deviations = estimator.estimates(on)[0].deviation;
        for (std::size_t i = 0; i < on.size(); ++i) {
            INFO(spec << " " << i << " " << deviations[i] * 1e9);
            REQUIRE(deviations[i] == 0);
        }
        std::vector<ValueQuery> at;
        for (const std::uint32_t i : back) {
            at.push_back({model.samples.positions[i]});
        }
        const auto estimates = estimator.estimates(at);
        std::size_t within_two = 0;
        for (std::size_t k = 0; k < back.size(); ++k) {
            const double error = estimates[0].value[k] - model.samples.values[0][back[k]];
            within_two += std::abs(error) <= 2 * estimates[0].deviation[k] ? 1 : 0;
            // The logarithmic twin has the same errors in decades.
            REQUIRE(estimates[1].deviation[k] == Approx(estimates[0].deviation[k]).margin(1e-9));
        }
        const double share = static_cast<double>(within_two) / static_cast<double>(back.size());
        INFO(spec << " covers " << share);
        CHECK(share > 0.85);
        CHECK(share <= 1);
    }
}

TEST_CASE("R6: estimates have the same bits at any thread count") {
    const Model model = wells_model();
    const auto queries = queries_in({{-100, -100, 0}, {1100, 1100, 1000}}, 9000, 35);
    const auto all = [&] {
        return ModelEstimator(model, no_faults(), parse_estimator("idw"), {}, {.uncertainty = true}).estimates(queries);
    };
    const auto parallel = all();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto serial = all();
    for (std::size_t p = 0; p < 4; ++p) {
        REQUIRE(same_bits(parallel[p].value, serial[p].value));
        REQUIRE(same_bits(parallel[p].deviation, serial[p].deviation));
        REQUIRE(same_bits(parallel[p].entropy, serial[p].entropy));
        REQUIRE(parallel[p].samples == serial[p].samples);
    }
}

TEST_CASE("Folds take each sample once, boreholes whole, loose samples in blocks") {
    Samples samples;
    Random random(36);
    for (int i = 0; i < 200; ++i) {
        samples.positions.push_back(random.in({{0, 0, 0}, {1000, 1000, 100}}));
        samples.borehole.push_back(i < 120 ? i / 10 : -1);
    }
    std::vector<std::uint32_t> which(200);
    std::iota(which.begin(), which.end(), 0u);
    for (const std::size_t most : {0, 5}) {
        const auto folds = folds_of(samples, which, most, 8);
        CHECK(folds.size() == (most ? most : 12 + 8));
        std::vector<int> fold_of(200, -1);
        for (std::size_t f = 0; f < folds.size(); ++f) {
            CHECK(!folds[f].empty());
            for (const std::uint32_t i : folds[f]) {
                REQUIRE(fold_of[i] == -1);
                fold_of[i] = static_cast<int>(f);
            }
        }
        for (std::size_t i = 0; i < 120; ++i) {
            REQUIRE(fold_of[i] == fold_of[i / 10 * 10]);
        }
        CHECK(std::count(fold_of.begin(), fold_of.end(), -1) == 0);
    }
    samples.borehole.assign(200, 3);
    CHECK(folds_of(samples, which).size() == 1);
}

TEST_CASE("One borehole alone leaves no one to tell its error: deviations stay unknown") {
    Model model = wells_model(1, 20);
    const auto estimates = ModelEstimator(model, no_faults(), parse_estimator("idw"), {}, {.uncertainty = true})
                               .estimates(queries_in({{0, 0, 0}, {1000, 1000, 1000}}, 50, 37));
    for (std::size_t i = 0; i < 50; ++i) {
        CHECK(std::isnan(estimates[0].deviation[i]));
        CHECK(!std::isnan(estimates[0].value[i]));
    }
}

TEST_CASE("Uncertainty becomes properties of the vertices, once however often it is asked for") {
    Model model = wells_model();
    const auto queries = queries_in({{0, 0, 0}, {1000, 1000, 1000}}, 200, 38);
    for (const auto& query : queries) {
        model.vertices.push_back({model.vertices.size(), query.position, Role::inserted, -1, 0});
    }
    const ModelEstimator before(model, no_faults(), parse_estimator("natural"), {}, {.uncertainty = true});
    const auto estimates = before.estimates(queries);
    model.vertex_values = {before.values(queries).values, std::vector<double>(queries.size(), 0)};

    add_uncertainty(model, before);
    std::vector<std::string> names;
    for (const auto& property : model.properties) {
        names.push_back(property.name);
    }
    const std::vector<std::string> wanted{"grade",
                                          "K",
                                          "rock",
                                          "nothing",
                                          "grade_sd",
                                          "grade_ci95",
                                          "grade_extrapolation",
                                          "grade_samples",
                                          "K_sd",
                                          "K_ci95",
                                          "K_extrapolation",
                                          "K_samples",
                                          "rock_entropy",
                                          "rock_p_clay",
                                          "rock_p_sand",
                                          "rock_p_till",
                                          "rock_extrapolation",
                                          "rock_samples"};
    CHECK(names == wanted);
    CHECK(model.properties[8].unit == "decade");
    CHECK(model.properties[9].unit == "decade");
    CHECK(same_bits(model.vertex_values.values[4], estimates[0].deviation));
    CHECK(same_bits(model.vertex_values.values[5], estimates[0].half_width));
    CHECK(same_bits(model.vertex_values.values[14], estimates[2].probability[1]));
    CHECK(model.samples.values.size() == names.size());

    const ModelEstimator again(model, no_faults(), parse_estimator("idw"), {}, {.uncertainty = true});
    const auto others = again.estimates(queries);
    add_uncertainty(model, again);
    CHECK(model.properties.size() == names.size());
    CHECK(same_bits(model.vertex_values.values[4], others[0].deviation));
}

TEST_CASE("Kriging is fitted to each property, says so, and is taken up again as it was") {
    const Model model = wells_model();
    const auto queries = queries_in({{0, 0, 0}, {1000, 1000, 1000}}, 500, 39);
    const ModelEstimator fitted(model, no_faults(), parse_estimator("kriging"), {}, {.uncertainty = true});
    const auto estimates = fitted.estimates(queries);
    CHECK(fitted.plan().of_property.size() == 3);
    CHECK(estimates[0].deviation_source == DeviationSource::kriging);
    CHECK(estimates[2].deviation_source == DeviationSource::none);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        REQUIRE(estimates[0].deviation[i] > 0);
        REQUIRE(estimates[0].samples[i] <= 24);
        double sum = 0;
        for (const auto& column : estimates[2].probability) {
            REQUIRE(column[i] >= 0);
            sum += column[i];
        }
        REQUIRE(sum == Approx(1).margin(1e-12));
    }
    const ModelEstimator again(model, no_faults(), parse_estimator_plan(fitted.plan().to_string()));
    CHECK(again.plan().to_string() == fitted.plan().to_string());
    REQUIRE(same_bits(again.values(queries).values[0], estimates[0].value));

    Model one = wells_model();
    one.properties.resize(1);
    one.samples.values.resize(1);
    const ModelEstimator alone(one, no_faults(), parse_estimator("kriging"));
    CHECK(alone.plan().of_property.empty());
    CHECK_FALSE(needs_values(alone.plan().general));
}

TEST_CASE("Degenerate samples give defined estimates: none, few, in a line, in a plane, all equal") {
    const std::vector<ValueQuery> queries = {{{0, 0, 0}}, {{0.5, 0.2, 0.1}}, {{10, -20, 30}}, {{1, 0, 0}}};
    for (const std::string spec : {"natural", "idw", "kriging", "kriging:drift=linear:model=gaussian", "nearest"}) {
        for (std::size_t n = 0; n <= 4; ++n) {
            for (int kind = 0; kind < 3; ++kind) {
                Model model;
                model.properties = {{"v", "", Scale::linear, Kind::continuous, {}}};
                model.samples.values.resize(1);
                for (std::size_t i = 0; i < n; ++i) {
                    const double t = double(i);
                    model.samples.positions.push_back(kind == 0   ? Vec3{t, t * t, t * t * t}
                                                      : kind == 1 ? Vec3{t, 0, 0}
                                                                  : Vec3{t, t * t, 0});
                    model.samples.borehole.push_back(static_cast<std::int32_t>(i));
                    model.samples.values[0].push_back(kind == 1 ? 7 : t);
                }
                const auto e = ModelEstimator(model, no_faults(), parse_estimator(spec), {}, {.uncertainty = true})
                                   .estimates(queries)[0];
                for (std::size_t i = 0; i < queries.size(); ++i) {
                    CAPTURE(spec, n, kind, i);
                    CHECK(std::isnan(e.value[i]) == (n == 0));
                    CHECK((n == 0) == (e.samples[i] == 0));
                    CHECK((kind != 1 || n == 0 || std::abs(e.value[i] - 7) < 1e-9));
                    CHECK((std::isnan(e.deviation[i]) || e.deviation[i] >= 0));
                    CHECK((n < 2 || !std::isnan(e.deviation[i])));
                }
            }
        }
    }
}
