// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/estimator/estimator.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/plan/make_estimator.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "sites.hpp"
#include "tess/barrier_query.hpp"
#include "tess/error.hpp"
#include "tess/value_source.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

Weights weights_at(const Estimator& estimator, const ValueQuery& query) {
    Weights out;
    estimator.weights({&query, 1}, {&out, 1});
    return out;
}

/// Sites by distance from q, then coordinates.
std::vector<std::uint32_t> by_distance(const std::vector<Vec3>& sites, const Vec3& q) {
    std::vector<std::uint32_t> order(sites.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const double da = squared_distance(sites[a], q);
        const double db = squared_distance(sites[b], q);
        return da != db ? da < db : sites[a] < sites[b];
    });
    return order;
}

std::string message_of(const std::string& spec) {
    try {
        parse_estimator(spec);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("Estimator specifications are written out with every default") {
    CHECK(parse_estimator("nearest").to_string() == "nearest");
    CHECK(parse_estimator("natural").to_string() == "natural");
    CHECK(parse_estimator("idw").to_string() == "idw:power=2:max_points=12");
    CHECK(parse_estimator("idw:max_points=4:radius=250.5:power=3").to_string() ==
          "idw:power=3:radius=250.5:max_points=4");
    CHECK(EstimatorSpec{}.to_string() == "natural");
    for (const std::string text :
         {"nearest", "natural", "laplace:dip=30:ratio3=0.2", "idw:power=1.5:radius=10:max_points=7"}) {
        CHECK(parse_estimator(parse_estimator(text).to_string()).to_string() == text);
    }
}

TEST_CASE("Wrong estimator specifications are refused with what there is") {
    CHECK(message_of("kringing") ==
          "estimator 'kringing' is not known; there are natural, laplace, linear, idw, kriging, nearest, auto; "
          "did you mean kriging?");
    CHECK(message_of("").find("there are natural, laplace, linear, idw, kriging, nearest, auto") != std::string::npos);
    CHECK(message_of("idw:pwr=2") ==
          "estimator 'idw' has no option 'pwr'; it has power, radius, max_points, "
          "per_octant, per_borehole, anisotropy, azimuth, dip, roll, ratio2, ratio3");
    CHECK(message_of("natural:power=2") ==
          "estimator 'natural' has no option 'power'; it has smooth, anisotropy, azimuth, dip, roll, ratio2, ratio3");
    CHECK(message_of("idw:power=two") == "estimator 'idw': power='two' is not a number from 0 to 100");
    CHECK(message_of("idw:radius=-1") == "estimator 'idw': radius='-1' is not a number above 0");
    CHECK(message_of("idw:power=1:power=2") == "estimator 'idw': power is given twice");
    for (const std::string text :
         {"idw:", "idw:power", "idw:power=", "idw:power=nan", "idw:radius=inf", "idw:radius=0", "idw:max_points=0",
          "idw:max_points=2.5", "idw:max_points=1e9", "idw:power=2 ", "idw:power=2:", "Natural", "natural "}) {
        CAPTURE(text);
        CHECK_THROWS_AS(parse_estimator(text), UsageError);
    }
}

TEST_CASE("Nearest takes the nearest site, of equally near ones the first by coordinates") {
    Random random(1);
    for (const auto& sites : {uniform_sites(500), lattice_sites(7)}) {
        const auto estimator = make_estimator(parse_estimator("nearest"), sites, nullptr);
        const Box3 box = bounding_box(sites).grown(0.3 * bounding_box(sites).diagonal());
        for (int i = 0; i < 500; ++i) {
            Vec3 q = random.in(box);
            if (i % 2) {
                q = {std::floor(q.x) + 0.5, std::floor(q.y) + 0.5, std::floor(q.z)};  // ties on the lattice
            }
            const auto w = weights_at(*estimator, {q});
            REQUIRE(w.terms.size() == 1);
            REQUIRE(w.terms[0].site == by_distance(sites, q).front());
            REQUIRE(w.terms[0].weight == 1);
        }
    }
}

TEST_CASE("Inverse distance weights follow the formula over the nearest sites, ties included") {
    Random random(2);
    for (const auto& sites : {uniform_sites(400), lattice_sites(6)}) {
        const double reach = 0.25 * bounding_box(sites).diagonal();
        const auto estimator =
            make_estimator(parse_estimator("idw:power=3:max_points=9:radius=" + std::to_string(reach)), sites, nullptr);
        const double radius = std::stod(std::to_string(reach));
        for (int i = 0; i < 300; ++i) {
            Vec3 q = random.in(bounding_box(sites));
            if (i % 2) {
                q = {std::floor(q.x) + 0.5, std::floor(q.y) + 0.5, std::floor(q.z) + 0.5};
            }
            auto expected = by_distance(sites, q);
            expected.resize(9);
            std::erase_if(expected, [&](std::uint32_t s) { return distance(sites[s], q) > radius; });
            double sum = 0;
            for (const std::uint32_t s : expected) {
                sum += std::pow(distance(sites[s], q), -3);
            }
            const auto w = weights_at(*estimator, {q});
            REQUIRE(w.terms.size() == expected.size());
            for (std::size_t k = 0; k < expected.size(); ++k) {
                REQUIRE(w.terms[k].site == expected[k]);
                REQUIRE(w.terms[k].weight ==
                        Approx(std::pow(distance(sites[expected[k]], q), -3) / sum).epsilon(1e-12));
            }
        }
    }
}

TEST_CASE("Inverse distance: a site alone on itself, no value beyond the radius, no overflow beside a site") {
    const std::vector<Vec3> sites = {{0, 0, 0}, {10, 0, 0}};
    const auto limited = make_estimator(parse_estimator("idw:radius=4"), sites, nullptr);
    CHECK(weights_at(*limited, {{5, 0, 0}}).terms.empty());
    REQUIRE(weights_at(*limited, {{4, 0, 0}}).terms.size() == 1);
    const auto on = weights_at(*limited, {{10, 0, 0}});
    REQUIRE(on.terms.size() == 1);
    CHECK(on.terms[0].site == 1);
    const auto steep = make_estimator(parse_estimator("idw:power=100"), sites, nullptr);
    const auto beside = weights_at(*steep, {{1e-12, 0, 0}});
    REQUIRE(beside.terms.size() == 2);
    CHECK(beside.terms[0].weight == 1);
    CHECK(beside.terms[1].weight == 0);
}

TEST_CASE("E1: no estimator gives any weight to a site across a fault") {
    const std::vector<Barrier> faults = {fault_at_x(500, -10'000, 10'000)};
    const BarrierQuery proximity(faults);
    const auto sites = uniform_sites(600, 3);
    for (const std::string spec : {"nearest", "idw:max_points=20", "natural"}) {
        CAPTURE(spec);
        const auto estimator = make_estimator(parse_estimator(spec), sites, &proximity);
        Random random(4);
        for (int i = 0; i < 2000; ++i) {
            ValueQuery query{random.in({{-100, -100, -100}, {1100, 1100, 1100}})};
            if (i % 3 == 0) {  // where seeds stand, and far nearer
                query.side = i % 2 ? 1 : -1;
                query.barrier = 0;
                query.position.x = 500 + query.side * (i % 9 ? faults[0].width / 2 : 1e-9);
            }
            const auto w = weights_at(*estimator, query);
            REQUIRE(!w.terms.empty());
            double sum = 0;
            for (const auto& [site, weight] : w.terms) {
                REQUIRE((sites[site].x > 500) == (query.position.x > 500));
                REQUIRE(weight >= 0);
                sum += weight;
            }
            REQUIRE(sum == Approx(1).margin(1e-12));
        }
    }
}

TEST_CASE("E1: a fault block without samples gets no value, from any estimator") {
    const std::vector<Barrier> faults = {fault_at_x(2000, -1e5, 1e5), fault_at_x(-1000, -1e5, 1e5)};
    const BarrierQuery proximity(faults);
    const auto sites = uniform_sites(200, 5);
    for (const std::string spec : {"nearest", "idw", "natural"}) {
        CAPTURE(spec);
        const auto estimator = make_estimator(parse_estimator(spec), sites, &proximity);
        for (const double x : {2001.0, 2500.0, -1500.0, 1e6}) {
            CHECK(weights_at(*estimator, {{x, 500, 500}}).terms.empty());
        }
        CHECK(!weights_at(*estimator, {{1999, 500, 500}}).terms.empty());
    }
}

TEST_CASE("Where all natural neighbours are hidden the nearest visible site counts, and that is said") {
    // One site is beyond a small fault from the query; it is round the fault's rim that another can be seen.
    const std::vector<Barrier> faults = {fault_at_x(0, -5, 5), fault_at_x(-40, -60, 60)};
    const BarrierQuery proximity(faults);
    std::vector<Vec3> sites;
    for (double y = -4; y <= 4; ++y) {
        for (double z = -4; z <= 4; ++z) {
            sites.push_back({1, y, z});
            sites.push_back({-42, 10 * y, 10 * z});
        }
    }
    sites.push_back({300, 300, 300});
    const auto estimator = make_estimator(parse_estimator("natural"), sites, &proximity);
    const Vec3 q{-0.5, 0.2, 0.1};
    const auto w = weights_at(*estimator, {q});
    for (const auto& term : w.terms) {
        CHECK(!proximity.crosses_any(q, sites[term.site]));
    }
    if (w.terms.empty()) {
        for (const Vec3& site : sites) {
            CHECK(proximity.crosses_any(q, site));
        }
    } else {
        CHECK(w.fallback == (w.terms.size() == 1));
    }
    const auto nearest = weights_at(*make_estimator(parse_estimator("nearest"), sites, &proximity), {q});
    CHECK(w.terms.size() == nearest.terms.size());
}
