// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/plan/cross_validation.hpp"
#include "interp/estimator_spec.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "estimation.hpp"
#include "sites.hpp"
#include "tess/property.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

Model wells_model() {
    Model model;
    model.properties = {{"grade", "%", Scale::linear, Kind::continuous, {}},
                        {"rock", "", Scale::linear, Kind::categorical, {"a", "b"}}};
    model.samples.positions = borehole_sites(25, 20, 81);
    model.samples.values.resize(2);
    Random random(82);
    for (std::size_t i = 0; i < 500; ++i) {
        const Vec3& p = model.samples.positions[i];
        model.samples.borehole.push_back(static_cast<std::int32_t>(i / 20));
        model.samples.depth.push_back(double(i % 20));
        model.samples.values[0].push_back(p.x / 500 + p.z / 300 + random(-0.2, 0.2));
        model.samples.values[1].push_back(p.z > 500 ? 0 : 1);
    }
    return model;
}

}  // namespace

TEST_CASE("Each borehole is estimated from the others alone") {
    const Model model = wells_model();
    const auto v = cross_validate(model, no_faults(), 0, parse_estimator("idw:max_points=8"));
    CHECK(v.folds == 25);
    for (std::size_t i = 0; i < 500; i += 13) {
        // From the definition: all samples but those of its borehole, by distance.
        std::vector<std::pair<double, double>> others;
        for (std::size_t j = 0; j < 500; ++j) {
            if (model.samples.borehole[j] != model.samples.borehole[i]) {
                others.emplace_back(distance(model.samples.positions[i], model.samples.positions[j]),
                                    model.samples.values[0][j]);
            }
        }
        std::sort(others.begin(), others.end());
        double sum = 0;
        double weights = 0;
        for (std::size_t k = 0; k < 8; ++k) {
            sum += others[k].second / (others[k].first * others[k].first);
            weights += 1 / (others[k].first * others[k].first);
        }
        REQUIRE(v.sample[i] == i);
        REQUIRE(v.estimated[i] == Approx(sum / weights).epsilon(1e-12));
        REQUIRE(v.deviation[i] > 0);
    }
}

TEST_CASE("Scores are those of their definitions") {
    CrossValidation v;
    v.measured = {1, 2, 3, 4, 5};
    v.estimated = {2, 1, 3, missing, 9};
    v.deviation = {1, 0.6, 0.1, 1, 2.5};
    v.half_width = {3, 0.9, 1, 1, 4};
    const Property grade{"g", "", Scale::linear, Kind::continuous, {}};
    const auto s = score(v, grade);
    CHECK(s.count == 4);
    CHECK(s.without_value == 1);
    CHECK(s.rmse == Approx(std::sqrt(18.0 / 4)));
    CHECK(s.mae == Approx(6.0 / 4));
    CHECK(s.bias == Approx(1));
    CHECK(s.rank_correlation == Approx(0.8));  // 1 − 6·Σd²/(n(n² − 1)) with d = 1, −1, 0, 0
    CHECK(s.within_one == Approx(0.5));
    CHECK(s.within_two == Approx(1.0));
    CHECK(s.within_half_width == Approx(0.75));
    v.estimated = {7, 7, 7, 7, 7};
    CHECK(std::isnan(score(v, grade).rank_correlation));
    const Property rock{"r", "", Scale::linear, Kind::categorical, {"a", "b"}};
    v.measured = {0, 1, 1, 0, 1};
    v.estimated = {0, 0, 1, 0, missing};
    CHECK(score(v, rock).accuracy == Approx(0.75));
    CHECK(std::isnan(score(v, rock).rmse));
}

TEST_CASE("Kriging's stated uncertainty covers what it should where its model is true") {
    const Model model = wells_model();
    const auto v = cross_validate(model, no_faults(), 0, parse_estimator("kriging:drift=linear"));
    const auto s = score(v, model.properties[0]);
    CHECK(v.deviation_source == DeviationSource::kriging);
    CHECK_FALSE(needs_values(v.estimator));
    CHECK(s.rank_correlation > 0.9);
    CHECK(s.within_two > 0.9);
    const auto rock = cross_validate(model, no_faults(), 1, parse_estimator("kriging"));
    CHECK(score(rock, model.properties[1]).accuracy > 0.9);
    CHECK(rock.deviation_source == DeviationSource::none);
}

TEST_CASE("Variograms are fitted without the holes left out: their values do not move their own estimates") {
    const Model model = wells_model();
    Model poisoned = model;
    for (std::size_t i = 100; i < 120; ++i) {  // all of hole 5
        poisoned.samples.values[0][i] += i % 2 == 0 ? 40 : -40;
    }
    const auto spec = parse_estimator("kriging:drift=constant:fit=classical");
    const auto before = cross_validate(model, no_faults(), 0, spec);
    const auto after = cross_validate(poisoned, no_faults(), 0, spec);
    CHECK(before.estimator.to_string() != after.estimator.to_string());  // the poison does reach a fit to all
    const auto hole = [](const CrossValidation& v) {
        return std::vector<double>(v.estimated.begin() + 100, v.estimated.begin() + 120);
    };
    CHECK(same_bits(hole(before), hole(after)));
    CHECK_FALSE(same_bits(before.estimated, after.estimated));
}

TEST_CASE("A model's factors are those of its cross-validation, whose fits do not see the holes left out") {
    Model model = wells_model();
    for (std::size_t i = 240; i < model.samples.size(); ++i) {  // 12 holes: each is a fold of both
        model.samples.values[0][i] = missing;
    }
    for (const std::string spec : {"kriging", "idw", "natural"}) {
        const auto v = cross_validate(model, no_faults(), 0, parse_estimator(spec));
        const ModelEstimator estimator(model, no_faults(), parse_estimator(spec), {}, {.uncertainty = true});
        INFO(spec);
        CHECK(estimator.plan().calibrations.at("grade").to_string() == v.calibration.to_string());
    }
}

TEST_CASE("Boreholes count one by one where they are left out together") {
    const Model model = wells_model();
    for (const std::size_t folds : {0, 5, 22}) {
        const auto v = cross_validate(model, no_faults(), 0, parse_estimator("idw"), {.max_folds = folds});
        CHECK(v.folds == (folds == 0 ? 25 : folds));
        CHECK(v.calibration.boreholes == 25);
    }
}

TEST_CASE("R6: cross-validation has the same bits at any thread count") {
    const Model model = wells_model();
    for (const std::string spec : {"natural", "idw", "kriging", "nearest"}) {
        const auto parallel = cross_validate(model, no_faults(), 0, parse_estimator(spec));
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const auto serial = cross_validate(model, no_faults(), 0, parse_estimator(spec));
        CHECK(same_bits(parallel.estimated, serial.estimated));
        CHECK(same_bits(parallel.deviation, serial.deviation));
    }
}
