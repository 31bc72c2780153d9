// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "estimation.hpp"
#include "interp/estimator_plan.hpp"
#include "interp/plan/fitted_estimator.hpp"
#include "interp/kriging/variogram_fit.hpp"
#include "random_field.hpp"
#include "sites.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

std::vector<std::vector<double>> reference(const std::string& name) {
    std::vector<std::vector<double>> rows;
    for (const auto& cells : gstat_rows(name)) {
        auto& row = rows.emplace_back();
        for (const std::string& cell : cells) {
            row.push_back(std::stod(cell));
        }
    }
    return rows;
}

}  // namespace

TEST_CASE("Experimental variograms are gstat's, plain and robust") {
    std::vector<Vec3> places;
    std::vector<double> values;
    for (const auto& row : reference("samples.csv")) {
        places.push_back({row[0], row[1], row[2]});
        values.push_back(row[3]);
    }
    const auto rows = reference("variogram.csv");
    REQUIRE(rows.size() == 30);
    for (const bool robust : {false, true}) {
        const auto lags = experimental_variogram(places, values, {}, {.width = 40, .lags = 15, .robust = robust});
        REQUIRE(lags.size() == 15);
        for (std::size_t i = 0; i < 15; ++i) {
            const auto& row = rows[i + (robust ? 15 : 0)];
            CHECK(lags[i].pairs == static_cast<std::uint64_t>(row[1]));
            CHECK(lags[i].distance == Approx(row[2]).epsilon(1e-12));
            CHECK(lags[i].semivariance == Approx(row[3]).epsilon(1e-10));
        }
    }
}

TEST_CASE("Pairs are chosen by direction, by borehole and by class as asked") {
    const auto places = borehole_sites(6, 30, 71);
    std::vector<std::int32_t> holes;
    std::vector<double> values;
    Random random(72);
    for (std::size_t i = 0; i < places.size(); ++i) {
        holes.push_back(static_cast<std::int32_t>(i / 30));
        values.push_back(double(random.below(3)));
    }
    const auto count = [&](const VariogramOptions& options, const auto& wanted, const auto& squared) {
        const auto lags = experimental_variogram(places, values, holes, options);
        for (std::size_t k = 0; k < options.lags; ++k) {
            std::uint64_t pairs = 0;
            double sum = 0;
            for (std::size_t i = 0; i < places.size(); ++i) {
                for (std::size_t j = i + 1; j < places.size(); ++j) {
                    const double h = distance(places[i], places[j]);
                    if (h > double(k) * options.width && h <= double(k + 1) * options.width && wanted(i, j, h)) {
                        ++pairs;
                        sum += squared(values[i], values[j]);
                    }
                }
            }
            const auto lag = std::find_if(lags.begin(), lags.end(), [&](const Lag& l) {
                return l.distance > double(k) * options.width && l.distance <= double(k + 1) * options.width;
            });
            REQUIRE((lag == lags.end() ? 0 : lag->pairs) == pairs);
            if (pairs > 0) {
                REQUIRE(lag->semivariance == Approx(0.5 * sum / double(pairs)));
            }
        }
    };
    const auto square = [](double a, double b) { return (a - b) * (a - b); };
    count(
        {.width = 60, .pairs = PairKind::same_borehole}, [&](auto i, auto j, double) { return holes[i] == holes[j]; },
        square);
    count(
        {.width = 60, .pairs = PairKind::other_borehole, .horizontal = true},
        [&](auto i, auto j, double h) {
            return holes[i] != holes[j] &&
                   std::abs(places[i].z - places[j].z) <= std::sin(22.5 * std::numbers::pi / 180) * h;
        },
        square);
    const Vec3 east{1, 0, 0};
    count(
        {.width = 80, .direction = east, .tolerance_deg = 30},
        [&](auto i, auto j, double h) {
            return std::abs(places[i].x - places[j].x) >= std::cos(30 * std::numbers::pi / 180) * h;
        },
        square);
    // Half the sum of the squared differences of all classes' indicators is 1 for different classes.
    count(
        {.width = 60, .categorical = true}, [](auto, auto, double) { return true; },
        [](double a, double b) { return a == b ? 0.0 : 2.0; });
}

TEST_CASE("A model is found again in its own variogram, for every family") {
    for (const auto family : {VariogramFamily::spherical, VariogramFamily::exponential, VariogramFamily::gaussian,
                              VariogramFamily::matern}) {
        const Variogram truth{family, 1.5, 0.3, 1.7, 120, {}};
        std::vector<Lag> lags;
        for (int k = 1; k <= 15; ++k) {
            lags.push_back({30.0 * k, truth(30.0 * k), 100});
        }
        const Variogram found = fit_model(lags, {family, 1.5, 0, 1, 1, {}}, {}, {}, {});
        INFO(to_string(family));
        CHECK(found.nugget == Approx(0.3).margin(0.01));
        CHECK(found.sill == Approx(1.7).margin(0.01));
        CHECK(found.range == Approx(120).epsilon(0.005));
        const Variogram kept = fit_model(lags, {family, 1.5, 0, 1, 1, {}}, 0.5, {}, 100.0);
        CHECK(kept.nugget == 0.5);
        CHECK(kept.range == 100);
        CHECK(kept.correlation(kept.practical_range()) ==
              Approx(0.05).margin(family == VariogramFamily::spherical ? 0.06 : 1e-9));
    }
}

TEST_CASE("Ranges along holes and across them are fitted apart") {
    // 100 wells 100 m apart, a sample every 4 m; ranges of 150 m across and 15 m along.
    const RandomField field(150, 15, 73);
    std::vector<Vec3> places;
    std::vector<std::int32_t> holes;
    std::vector<double> values;
    for (int hole = 0; hole < 100; ++hole) {
        for (int i = 0; i < 50; ++i) {
            places.push_back({100.0 * (hole % 10), 100.0 * (hole / 10), -4.0 * i});
            holes.push_back(hole);
            values.push_back(field(places.back()));
        }
    }
    const VariogramFit fit = fit_variogram(places, values, holes, {.family = VariogramFamily::exponential});
    CHECK(fit.apart);
    INFO(fit.variogram.nugget << " " << fit.variogram.sill << " " << fit.variogram.range << " "
                              << fit.variogram.anisotropy.ratio3);
    CHECK(fit.variogram.nugget + fit.variogram.sill == Approx(1).margin(0.35));
    CHECK(fit.variogram.range == Approx(150).margin(75));
    CHECK(fit.variogram.range * fit.variogram.anisotropy.ratio3 == Approx(15).margin(7));
    // What is given stays.
    const Variogram given =
        fit_variogram(places, values, holes, {.nugget = 0.2, .range = 333, .ratio3 = 0.5}).variogram;
    CHECK(given.nugget == 0.2);
    CHECK(given.range == 333);
    CHECK(given.anisotropy.ratio3 == 0.5);
}

TEST_CASE("Fits never fail: no samples to speak of, equal values, one place in space") {
    for (const std::size_t n : {1, 2, 3, 5}) {
        const auto places = uniform_sites(n, 74);
        for (const double step : {0.0, 1.0}) {
            std::vector<double> values;
            for (std::size_t i = 0; i < n; ++i) {
                values.push_back(step * double(i));
            }
            const Variogram v = fit_variogram(places, values, std::vector<std::int32_t>(n, -1), {}).variogram;
            CHECK(v.range > 0);
            CHECK(v.nugget >= 0);
            CHECK(v.sill >= 0);
            CHECK(std::isfinite(v.nugget + v.sill + v.range));
        }
    }
    const auto places = borehole_sites(10, 30, 75);
    const Variogram v =
        fit_variogram(places, std::vector<double>(300, 7.0), std::vector<std::int32_t>(300, 0), {}).variogram;
    CHECK(v.nugget == 0);
    CHECK(v.sill == 0);
}

TEST_CASE("A kriging specification is completed from values, and kept when it is complete") {
    const auto places = borehole_sites(20, 30, 76);
    std::vector<double> values;
    std::vector<std::int32_t> holes;
    for (std::size_t i = 0; i < places.size(); ++i) {
        values.push_back(std::sin(places[i].x / 100) + places[i].z / 200);
        holes.push_back(static_cast<std::int32_t>(i / 30));
    }
    const auto open = parse_estimator("kriging:model=exponential:nugget=0.25");
    CHECK(needs_values(open));
    const auto complete = fitted_estimator(open, places, values, holes);
    CHECK_FALSE(needs_values(complete));
    CHECK(complete.options.at("nugget") == "0.25");
    CHECK(fitted_estimator(complete, places, {}, holes).to_string() == complete.to_string());
    CHECK(parse_estimator(complete.to_string()).to_string() == complete.to_string());
    CHECK_FALSE(needs_values(parse_estimator("idw")));

    EstimatorPlan plan{parse_estimator("idw")};
    plan.of_property["K of clay"] = complete;
    plan.of_property["grade"] = parse_estimator("nearest");
    CHECK(parse_estimator_plan(plan.to_string()).to_string() == plan.to_string());
    CHECK(parse_estimator_plan(plan.to_string()).of("K of clay").to_string() == complete.to_string());
    CHECK(parse_estimator_plan(plan.to_string()).of("other").name == "idw");
}
