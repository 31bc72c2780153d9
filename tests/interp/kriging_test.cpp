// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/kriging/kriging.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/plan/make_estimator.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "estimation.hpp"
#include "interp/estimator/estimator.hpp"
#include "sites.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

Vec3 place(const std::vector<std::string>& row) {
    return {std::stod(row[0]), std::stod(row[1]), std::stod(row[2])};
}

const std::string any_kriging = "kriging:nugget=0.1:sill=1:range=300:ratio3=1";

std::vector<Weights> weights_at(const std::string& spec, const std::vector<Vec3>& sites,
                                const std::vector<Vec3>& places, const std::vector<std::int32_t>& boreholes = {}) {
    const auto estimator = make_estimator(parse_estimator(spec), sites, nullptr, boreholes);
    return testing::weights_at(*estimator, places);
}

/// Finite, and summing to 1.
void require_sound(const Weights& w) {
    double sum = 0;
    for (const auto& term : w.terms) {
        REQUIRE(std::isfinite(term.weight));
        sum += term.weight;
    }
    REQUIRE(sum == Approx(1).margin(1e-6));
    REQUIRE(w.variance >= 0);
    REQUIRE(std::isfinite(w.variance));
    REQUIRE((w.beyond >= 0 && w.beyond <= 1));
}

}  // namespace

TEST_CASE("Kriging gives gstat's values and variances: every model, drift, anisotropy, neighbourhood") {
    std::vector<Vec3> sites;
    std::vector<double> values;
    for (const auto& row : gstat_rows("samples.csv")) {
        sites.push_back(place(row));
        values.push_back(std::stod(row[3]));
    }
    std::vector<Vec3> places;
    for (const auto& row : gstat_rows("places.csv")) {
        places.push_back(place(row));
    }
    std::map<std::string, std::vector<Weights>> results;
    for (const auto& row : gstat_rows("kriging.csv")) {
        std::string spec = row[0];
        for (const std::string option : {"per_octant=0", "per_borehole=0", "ratio3=1"}) {
            const std::string key = option.substr(0, option.find('='));
            spec += spec.find(key) == std::string::npos ? ":" + option : "";
        }
        if (!results.contains(spec)) {
            results[spec] = weights_at(spec, sites, places);
        }
        const Weights& w = results[spec][std::stoul(row[1])];
        double value = 0;
        for (const auto& [site, weight] : w.terms) {
            value += weight * values[site];
        }
        INFO(spec << " at place " << row[1]);
        if (row[2] == "NA") {
            CHECK(w.terms.empty());
            continue;
        }
        CHECK(std::abs(value - std::stod(row[2])) <= 1e-8);
        CHECK(std::abs(w.variance - std::stod(row[3])) <= 1e-8);
        CHECK_FALSE(w.fallback);
    }
    CHECK(results.size() == 12);
}

TEST_CASE("On a site kriging gives its value with no variance; far from all, the mean") {
    const auto sites = uniform_sites(200, 61);
    for (const auto& w : weights_at(any_kriging, sites, sites)) {
        REQUIRE(w.terms.size() == 1);
        REQUIRE(w.variance == 0);
    }
    const auto far = weights_at(any_kriging, sites, {{1e5, 0, 0}}).front();
    CHECK(far.beyond == 1);
    CHECK(far.variance > 1.1);
}

TEST_CASE("Universal kriging reproduces planes, far outside too") {
    const auto sites = uniform_sites(300, 62);
    const auto places = uniform_sites(50, 63);
    const auto plane = [](const Vec3& p) { return 3 + 0.1 * p.x - 0.2 * p.y + 0.05 * p.z; };
    for (const double stretch : {1.0, 3.0}) {
        std::vector<Vec3> queries;
        for (const Vec3& p : places) {
            queries.push_back(stretch * p);
        }
        const auto all = weights_at(any_kriging + ":drift=linear", sites, queries);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            double value = 0;
            for (const auto& [site, weight] : all[i].terms) {
                value += weight * plane(sites[site]);
            }
            require_sound(all[i]);
            REQUIRE(value == Approx(plane(queries[i])).margin(1e-7));
        }
    }
}

TEST_CASE("Singular kriging systems fall back, counted, and give finite weights that sum to 1") {
    std::vector<Vec3> line;
    std::vector<Vec3> plane;
    std::vector<Vec3> clump;
    for (int i = 0; i < 40; ++i) {
        line.push_back({0, 0, double(i)});
        plane.push_back({double(i % 7), double(i / 7), 0});
        clump.push_back({1e-9 * i, 1e-9 * (i % 5), 0});  // nearly at one place
    }
    const std::vector<Vec3> places = {{1, 2, 3}, {0, 0, 3.5}, {100, 0, 0}, {2.5, 2.5, 0}, {1e-7, 1e-7, 1e-7}};
    for (const std::string model : {"spherical", "exponential", "gaussian", "matern"}) {
        for (const std::string drift : {"constant", "linear"}) {
            for (const auto& sites : {line, plane, clump}) {
                const auto all = weights_at(
                    "kriging:model=" + model + ":drift=" + drift + ":nugget=0:sill=2:range=50:ratio3=1", sites, places);
                for (const auto& w : all) {
                    require_sound(w);
                    CAPTURE(model, drift);
                    CHECK((w.fallback || drift == "constant"));
                }
            }
            const auto flat = weights_at("kriging:model=gaussian:nugget=0:sill=1:range=1e6:ratio3=1", line, places);
            CHECK(flat.front().fallback);
            CHECK(flat.front().variance < 1e-3);  // solved with a nugget, not given up
            for (const auto& w : flat) {
                require_sound(w);
            }
        }
    }
}

TEST_CASE("One to four sites, a variance of nothing, and no site in reach are all defined") {
    const std::vector<Vec3> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (std::size_t n = 1; n <= 4; ++n) {
        for (const std::string drift : {"constant", "linear"}) {
            const std::vector<Vec3> sites(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(n));
            const auto w = weights_at(any_kriging + ":drift=" + drift, sites, {{0.3, 0.3, 0.3}}).front();
            CHECK(w.terms.size() == n);
            require_sound(w);
        }
    }
    const auto nothing = weights_at("kriging:nugget=0:sill=0:range=10:ratio3=1", corners, {{0.2, 0.3, 0.4}}).front();
    require_sound(nothing);
    CHECK(nothing.variance == 0);
    CHECK_FALSE(nothing.fallback);
    CHECK(weights_at(any_kriging + ":radius=5", corners, {{100, 0, 0}}).front().terms.empty());
}

TEST_CASE("R6: kriging has the same bits alone and in any batch, at any thread count") {
    const auto sites = borehole_sites(30, 40, 64);
    std::vector<std::int32_t> holes;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        holes.push_back(static_cast<std::int32_t>(i / 40));
    }
    auto places = uniform_sites(1500, 65);
    for (std::size_t i = 0; i < 500; ++i) {
        places[i] = {500 + 0.01 * double(i), 500, 500};  // these share their neighbours
    }
    const auto all = weights_at(any_kriging, sites, places, holes);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto serial = weights_at(any_kriging, sites, places, holes);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto single = i % 10 == 0 ? weights_at(any_kriging, sites, {places[i]}, holes).front() : serial[i];
        for (const auto& other : {serial[i], single}) {
            REQUIRE(all[i].terms.size() == other.terms.size());
            REQUIRE(all[i].variance == other.variance);
            for (std::size_t k = 0; k < other.terms.size(); ++k) {
                REQUIRE(all[i].terms[k].site == other.terms[k].site);
                REQUIRE(all[i].terms[k].weight == other.terms[k].weight);
            }
        }
    }
}
