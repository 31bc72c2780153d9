// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/linear_precision.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "estimation.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/model_estimator.hpp"
#include "interp/plan/extrapolation.hpp"
#include "interp/plan/make_estimator.hpp"
#include "sites.hpp"
#include "tess/barrier_query.hpp"
#include "tess/property.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

using Field = std::function<double(const Vec3&)>;

const std::vector<std::string> family = {"natural", "natural:smooth", "laplace", "linear"};
const std::vector<std::string> others = {"nearest", "idw", "kriging:nugget=0.1:sill=1:range=300:ratio3=1",
                                         "kriging:drift=linear:nugget=0:sill=1:range=300:ratio3=1"};

/// One continuous property at loose samples.
Model model_of(const std::vector<Vec3>& sites, const Field& field) {
    Model model;
    model.properties = {{"v", "", Scale::linear, Kind::continuous, {}}};
    model.samples.positions = sites;
    model.samples.borehole.assign(sites.size(), -1);
    model.samples.values.resize(1);
    for (const Vec3& p : sites) {
        model.samples.values[0].push_back(field(p));
    }
    return model;
}

std::vector<double> values_at(const Model& model, const BarrierQuery& faults, const std::string& spec,
                              const std::vector<Vec3>& places) {
    return ModelEstimator(model, faults, parse_estimator(spec)).values(queries_at(places)).values[0];
}

double worst_error(const std::vector<double>& values, const std::vector<Vec3>& places, const Field& field) {
    double worst = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double error = std::abs(values[i] - field(places[i]));
        worst = std::isnan(error) ? error : std::max(worst, error);
    }
    return worst;
}

/// 25 vertical holes with a sample every ten metres.
std::vector<Vec3> holes() {
    Random random(71);
    std::vector<Vec3> sites;
    for (int hole = 0; hole < 25; ++hole) {
        const double x = random(0, side), y = random(0, side);
        for (double z = -398; z < 0; z += 10) {
            sites.push_back({x, y, z});
        }
    }
    return sites;
}

/// A rectangle of random place and attitude.
Barrier random_fault(Random& random) {
    Barrier fault = fault_at_x(0, -random(150, 500), random(150, 500));
    const Vec3 at = random.in({{200, 200, 200}, {800, 800, 800}});
    const Vec3 n = random.in({{-1, -1, -1}, {1, 1, 1}});
    const Vec3 u = cross(n, {0.3, 0.5, 0.8}) / length(cross(n, {0.3, 0.5, 0.8})), v = cross(n, u) / length(n);
    for (Vec3& p : fault.sheet.vertices) {
        p = at + p.y * u + p.z * v;
    }
    return fault;
}

/// Of the sites, 20 a hole where there are holes, whether they see sites of six others.
std::vector<bool> sites_that_see_other_holes(const std::vector<Vec3>& sites, const BarrierQuery& faults) {
    std::vector<bool> out;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        std::set<std::size_t> holes;
        for (std::size_t j = 0; j < sites.size() && holes.size() < 6; ++j) {
            if (j / 20 != i / 20 && !holes.contains(j / 20) && !faults.crosses_any(sites[i], sites[j])) {
                holes.insert(j / 20);
            }
        }
        out.push_back(holes.size() == 6);
    }
    return out;
}

bool all_see_enough(const Weights& weights, const std::vector<bool>& sees_enough) {
    const auto& terms = weights.slope_terms.empty() ? weights.terms : weights.slope_terms;
    return std::all_of(terms.begin(), terms.end(), [&](const SiteWeight& term) { return sees_enough[term.site]; });
}

/// The part y < 500 of the plane x = 500.
Barrier half_fault() {
    Barrier fault = fault_at_x(500, -5000, 5000);
    for (Vec3& p : fault.sheet.vertices) {
        p.y = std::min(p.y, 500.0);
    }
    fault.spacing = 60;
    return fault;
}

}  // namespace

TEST_CASE("E2: between holes above a flat barrier the height is recovered, and a hair above it too") {
    const auto sites = holes();
    Barrier flat = fault_at_x(0, -2000, 3000);
    for (Vec3& p : flat.sheet.vertices) {
        p = {p.y, p.z, -200};
    }
    const std::vector<Barrier> faults = {flat};
    const BarrierQuery proximity(faults);
    Random random(72);
    std::vector<Vec3> places;
    for (int i = 0; i < 300; ++i) {
        places.push_back({random(250, 750), random(250, 750), -200 + (i % 3 ? random(0.1, 10) : random(10, 60))});
    }
    const Field height = [](const Vec3& p) { return p.z; };
    for (const auto& spec : family) {
        CAPTURE(spec);
        CHECK(worst_error(values_at(model_of(sites, height), proximity, spec, places), places, height) <= 400 * 1e-9);
    }
    CHECK(worst_error(values_at(model_of(sites, height), proximity, "idw", places), places, height) > 1);
}

TEST_CASE("E2: among random faults planes are recovered within the samples' hull") {
    for (const std::uint64_t seed : {1, 2}) {
        Random random(seed);
        std::vector<Barrier> faults(5);
        std::generate(faults.begin(), faults.end(), [&] { return random_fault(random); });
        const BarrierQuery proximity(faults);
        const Vec3 slope = random.in({{-1, -1, -1}, {1, 1, 1}});
        const Field plane = [&](const Vec3& p) { return 7 + dot(slope, p); };
        const double range = 1000 * (std::abs(slope.x) + std::abs(slope.y) + std::abs(slope.z));
        for (const auto& sites : {uniform_sites(800, seed), borehole_sites(40, 20, seed)}) {
            const auto places = places_in({{250, 250, 250}, {750, 750, 750}}, 600, 73);
            const auto sees_enough = sites_that_see_other_holes(sites, proximity);
            for (const auto& spec : family) {
                for (const char* anisotropy : {"", ":azimuth=30:dip=20:ratio2=0.7:ratio3=0.3"}) {
                    CAPTURE(seed, spec, anisotropy, sites.size());
                    const auto values = values_at(model_of(sites, plane), proximity, spec + anisotropy, places);
                    // Where a hole is cut off by itself its slopes are not determined, and far behind a fault they
                    // fade.
                    const auto weights =
                        weights_at(*make_estimator(parse_estimator(spec + anisotropy), sites, &proximity), places);
                    const double reach = reach_of(parse_estimator(spec + anisotropy), sites, {});
                    std::size_t promised = 0;
                    double worst = 0;
                    for (std::size_t i = 0; i < places.size(); ++i) {
                        if (weights[i].distance < reach && all_see_enough(weights[i], sees_enough)) {
                            ++promised;
                            worst = std::max(worst, std::abs(values[i] - plane(places[i])));
                        }
                    }
                    CHECK(promised > 500);
                    CHECK(worst <= 1e-9 * range);
                }
            }
        }
    }
}

TEST_CASE("E2: also just inside the hull, where thin cells reach the ghosts") {
    const auto sites = uniform_sites(1000, 74);
    const Field plane = [](const Vec3& p) { return 1 + p.x - 2 * p.y + 0.5 * p.z; };
    // Inside the hull without a doubt: on the way between two of the outermost sites.
    const auto at_x = [](const Vec3& a, const Vec3& b) { return a.x < b.x; };
    auto outermost = sites;
    std::sort(outermost.begin(), outermost.end(), at_x);
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < 30; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            places.push_back(0.5 * (outermost[i] + outermost[j]));
        }
    }
    for (const auto& spec : family) {
        CAPTURE(spec);
        CHECK(worst_error(values_at(model_of(sites, plane), no_faults(), spec, places), places, plane) <= 1e-9 * 3500);
    }
}

TEST_CASE("E2: where samples do not tell a slope, the plane of least slope is taken") {
    std::vector<Vec3> sites;  // all at y = 0
    Random random(75);
    for (int i = 0; i < 200; ++i) {
        sites.push_back({random(0, side), 0, random(0, side)});
    }
    const Field plane = [](const Vec3& p) { return 3 + p.x + 5 * p.y - 2 * p.z; };
    const Field least = [&](const Vec3& p) { return plane({p.x, 0, p.z}); };
    const auto places = places_in({{300, -60, 300}, {700, 60, 700}}, 200, 76);
    for (const std::string spec : {"natural", "laplace", "linear"}) {
        CAPTURE(spec);
        CHECK(worst_error(values_at(model_of(sites, plane), no_faults(), spec, places), places, least) <= 1e-9 * 3000);
    }
}

TEST_CASE("E2: where no neighbour is seen, the nearest visible sample's plane is taken") {
    // A wall with a window: from behind it, off the window, only what lies far on the other side of it is seen.
    std::vector<Barrier> faults(4, fault_at_x(0, -1, 1));
    const double window = 10, wall = 400;
    const std::array<std::array<double, 4>, 4> panels = {{{-wall, -window, -wall, wall},
                                                          {window, wall, -wall, wall},
                                                          {-window, window, -wall, -window},
                                                          {-window, window, window, wall}}};
    for (std::size_t k = 0; k < 4; ++k) {
        const auto [y0, y1, z0, z1] = panels[k];
        faults[k].sheet.vertices = {{0, y0, z0}, {0, y1, z0}, {0, y1, z1}, {0, y0, z1}};
        faults[k].spacing = 1;
    }
    const BarrierQuery proximity(faults);
    std::vector<Vec3> sites = places_in({{-60, -150, -150}, {-5, 150, 150}}, 300, 77);
    std::erase_if(sites, [](const Vec3& p) { return std::hypot(p.y, p.z) < 60; });
    const auto far = places_in({{-390, -40, -40}, {-300, 40, 40}}, 30, 78);
    sites.insert(sites.end(), far.begin(), far.end());
    const Field plane = [](const Vec3& p) { return p.x + p.y - p.z; };
    std::size_t met = 0;
    for (const auto& spec : family) {
        const auto estimator = make_estimator(parse_estimator(spec), sites, &proximity);
        std::vector<Vec3> places = places_in({{10, -1, -1}, {30, 1, 1}}, 50, 79);
        const auto weights = weights_at(*estimator, places);
        Model model = model_of(sites, plane);
        std::fill(model.samples.borehole.begin(), model.samples.borehole.end() - 30, 0);  // holes far apart: a long
        std::fill(model.samples.borehole.end() - 30, model.samples.borehole.end(), 1);    // reach
        const auto values = values_at(model, proximity, spec, places);
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (weights[i].hidden == 1 && !weights[i].terms.empty()) {
                ++met;
                REQUIRE(weights[i].terms.size() == 1);
                REQUIRE(std::abs(values[i] - plane(places[i])) <= 1e-9 * 1000);
            }
        }
    }
    CHECK(met > 10);
}

TEST_CASE("E1: with 0 and 1 on the two sides of a fault every estimate is 0 or 1, slopes and all") {
    const auto sites = uniform_sites(800, 81);
    const Field sides = [](const Vec3& p) { return p.x > 500 ? 1.0 : 0.0; };
    const auto check = [&](const Barrier& fault, const Box3& box, const std::vector<std::string>& specs) {
        const std::vector<Barrier> faults = {fault};
        const BarrierQuery proximity(faults);
        const auto places = places_in(box, 2000, 82);
        for (const auto& spec : specs) {
            CAPTURE(spec);
            CHECK(worst_error(values_at(model_of(sites, sides), proximity, spec, places), places, sides) <= 1e-12);
        }
    };
    check(fault_at_x(500, -2000, 3000), {{300, 0, 0}, {700, 1000, 1000}}, family);
    check(fault_at_x(500, -2000, 3000), {{300, 0, 0}, {700, 1000, 1000}}, others);
    // So far from an end that no neighbour lies round it, but some can be seen from neighbours.
    check(half_fault(), {{400, 50, 200}, {600, 250, 800}}, family);
}

TEST_CASE("E2: round a fault's end estimates with slopes are continuous") {
    const std::vector<Barrier> faults = {half_fault()};
    const BarrierQuery proximity(faults);
    Random random(83);
    const Model model = model_of(uniform_sites(1500, 84), [&](const Vec3& p) { return random() + 0.01 * p.x; });
    const auto largest_step = [&](const ModelEstimator& estimator, std::size_t steps) {
        std::vector<Vec3> arc;
        for (std::size_t i = 0; i <= steps; ++i) {
            const double angle =
                2 * std::numbers::pi * (0.001 + 0.998 * static_cast<double>(i) / static_cast<double>(steps));
            arc.push_back({500 + 90 * std::sin(angle), 500 - 90 * std::cos(angle), 480});
        }
        const auto values = estimator.values(queries_at(arc)).values[0];
        double largest = 0;
        for (std::size_t i = 1; i < arc.size(); ++i) {
            largest = std::max(largest, std::abs(values[i] - values[i - 1]));
        }
        return largest;
    };
    for (const auto& spec : family) {
        const ModelEstimator estimator(model, proximity, parse_estimator(spec));
        const double coarse = largest_step(estimator, 1000), fine = largest_step(estimator, 32'000);
        INFO(spec << ": " << coarse << " and " << fine);
        CHECK(fine < coarse / 10);
    }
}

TEST_CASE("E2: beside a fault or a hard horizon that ends, the plane of each side is recovered") {
    const Field sides = [](const Vec3& p) { return p.x > 500 ? 40 - 2 * p.x + p.z - p.y : 3 + p.x + p.y; };
    Model model = model_of(uniform_sites(1500, 97), sides);
    model.properties[0].hard_horizons = true;
    model.barriers = {half_fault()};
    const auto places = places_in({{440, 50, 250}, {560, 200, 750}}, 300, 98);
    for (const SurfaceKind kind : {SurfaceKind::fault, SurfaceKind::horizon}) {
        model.barriers[0].sheet.kind = kind;
        const BarrierQuery proximity = model_proximity(model);
        for (const auto& spec : family) {
            CAPTURE(to_string(kind), spec);
            CHECK(worst_error(values_at(model, proximity, spec, places), places, sides) <= 1e-9 * 4000);
        }
    }
}

TEST_CASE("What slopes add keeps within the range of the property's values, and fades away from the samples") {
    const std::vector<Barrier> faults = {half_fault()};
    const BarrierQuery proximity(faults);
    Random random(85);
    const Model model = model_of(uniform_sites(300, 86), [&](const Vec3&) { return random(-5, 7); });
    const auto [lowest, highest] = std::minmax_element(model.samples.values[0].begin(), model.samples.values[0].end());
    const auto places = places_in({{-1500, -1500, -1500}, {2500, 2500, 2500}}, 5000, 87);
    for (const std::string spec : {"natural", "laplace", "linear"}) {
        const auto values = values_at(model, proximity, spec, places);
        const auto weights =
            weights_at(*make_estimator(parse_estimator(spec), model.samples.positions, &proximity), places);
        std::size_t changed = 0, far = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            REQUIRE(values[i] >= *lowest - 1e-12);
            REQUIRE(values[i] <= *highest + 1e-12);
            const double plain = weighted_mean(weights[i].terms, model.samples.values[0]);
            changed += std::abs(values[i] - plain) > 1e-9 ? 1 : 0;
            if (weights[i].distance > 1500) {  // twice three times the spacing of some 150
                ++far;
                REQUIRE(values[i] == Approx(plain).margin(1e-12));
            }
        }
        CHECK(changed > 500);
        CHECK(far > 100);
    }
}

TEST_CASE("Where nothing is hidden and no ghost has a share, estimates are the weighted means, bit for bit") {
    const std::vector<Barrier> faults = {half_fault()};
    const BarrierQuery proximity(faults);
    Random random(88);
    const Model model = model_of(uniform_sites(1500, 89), [&](const Vec3&) { return random(-5, 7); });
    const auto places = places_in({{200, 200, 200}, {800, 800, 800}}, 1000, 90);
    for (const auto& spec : family) {
        const auto values = values_at(model, proximity, spec, places);
        const auto weights =
            weights_at(*make_estimator(parse_estimator(spec), model.samples.positions, &proximity), places);
        std::size_t open = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (weights[i].hidden == 0) {
                ++open;
                REQUIRE(values[i] == weighted_mean(weights[i].terms, model.samples.values[0]));
            }
        }
        CHECK(open > 300);
        CHECK(open < 950);
    }
}

TEST_CASE("A category is what the remaining weights say, without slopes") {
    const std::vector<Barrier> faults = {half_fault()};
    const BarrierQuery proximity(faults);
    Model model = model_of(uniform_sites(500, 91), [](const Vec3& p) { return std::floor(p.y / 400); });
    model.properties = {{"rock", "", Scale::linear, Kind::categorical, {"a", "b", "c"}}};
    const auto places = places_in({{400, -200, 0}, {600, 1200, 1000}}, 1000, 92);
    const auto estimates =
        ModelEstimator(model, proximity, parse_estimator("natural")).estimates(queries_at(places))[0];
    const auto weights =
        weights_at(*make_estimator(parse_estimator("natural"), model.samples.positions, &proximity), places);
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::array<double, 3> share{};
        for (const auto& [site, weight] : weights[i].terms) {
            share[static_cast<std::size_t>(model.samples.values[0][site])] += weight;
        }
        for (std::size_t c = 0; c < 3; ++c) {
            REQUIRE(estimates.probability[c][i] == Approx(share[c]).margin(1e-12));
        }
        REQUIRE(share[static_cast<std::size_t>(estimates.value[i])] == *std::max_element(share.begin(), share.end()));
    }
}

TEST_CASE("R6: slopes have the same bits in any order of queries, of rows and at any thread count") {
    const std::vector<Barrier> faults = {half_fault(), fault_at_x(300, -2000, 3000)};
    const BarrierQuery proximity(faults);
    const auto sites = borehole_sites(20, 40, 93);
    const Field field = [](const Vec3& p) { return std::sin(p.x / 90) + std::cos(p.y / 70) + p.z / 300; };
    const auto places = places_in({{-200, -200, -200}, {1200, 1200, 1200}}, 3000, 94);
    const auto together = values_at(model_of(sites, field), proximity, "natural", places);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        REQUIRE(same_bits(values_at(model_of(shuffled(sites, 95), field), proximity, "natural", places), together));
    }
    const Model model = model_of(sites, field);
    const ModelEstimator estimator(model, proximity, parse_estimator("natural"));
    for (std::size_t i = places.size(); i-- > 0;) {
        REQUIRE(estimator.values(queries_at({places[i]})).values[0][0] == together[i]);
    }
}
