// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/extrapolation.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "estimation.hpp"
#include "interp/model_estimator.hpp"
#include "sites.hpp"

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
    const std::vector<Fault> faults = {fault_at_x(350, -5000, 5000)};
    const FaultProximity proximity(faults);
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
