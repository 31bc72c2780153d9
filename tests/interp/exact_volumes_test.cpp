// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/exact_volumes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <string>

#include "estimation.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/plan/make_estimator.hpp"
#include "interp/base/morton.hpp"
#include "interp/natural/natural_neighbour.hpp"
#include "sites.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

constexpr auto sibson = Weighting::sibson;

struct Shape {
    std::string name;
    std::vector<Vec3> sites;
    double step;  ///< between neighbours
};

std::vector<Vec3> scaled(std::vector<Vec3> sites, double step) {
    for (auto& p : sites) {
        p = step * p;
    }
    return sites;
}

std::vector<Vec3> on_tilted_plane(std::size_t count) {
    Random random(2);
    std::vector<Vec3> sites(count);
    for (auto& p : sites) {
        const double x = std::floor(random(0, 4000)) / 4, y = std::floor(random(0, 4000)) / 4;
        p = {x, y, 0.5 * x + 0.25 * y};  // exactly
    }
    std::sort(sites.begin(), sites.end());
    sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
    return sites;
}

std::vector<Vec3> on_line(int count, const Vec3& step) {
    std::vector<Vec3> sites;
    for (int i = 0; i < count; ++i) {
        sites.push_back(double(i) * step);
    }
    return sites;
}

std::vector<Vec3> layers(int count, int side, double step, double apart) {
    std::vector<Vec3> sites;
    for (int layer = 0; layer < count; ++layer) {
        for (const Vec3& p : square_sites(side, step)) {
            sites.push_back(p + Vec3{0, 0, layer * apart});
        }
    }
    return sites;
}

/// Tenths are no doubles: there lattice planes and spheres hold to within rounding only.
std::vector<Shape> shapes() {
    return {{"lattice of tens", scaled(lattice_sites(12), 10), 10},
            {"lattice of tenths", scaled(lattice_sites(12), 0.1), 0.1},
            {"square of tens", square_sites(40, 10), 10},
            {"square of tenths", square_sites(40, 0.1), 0.1},
            {"tilted plane", on_tilted_plane(1500), 25},
            {"line", on_line(1500, {10, 0, 0}), 10},
            {"line of tenths", on_line(1500, {0.1, 0.2, -0.3}), 0.4},
            {"layers", layers(4, 20, 10, 37), 10}};
}

/// Middles and thirds of neighbours, half steps, and places beyond the hull on the lattice's planes.
std::vector<Vec3> places_of(const Shape& shape, std::size_t count) {
    Random random(5);
    const Box3 box = bounding_box(shape.sites);
    const double h = shape.step;
    const auto site = [&] { return shape.sites[random.below(shape.sites.size())]; };
    const auto half = [h](double x) { return std::round(2 * x / h) * h / 2; };
    std::vector<Vec3> places;
    while (places.size() < count) {
        const Vec3 a = site();
        const Vec3 b = a + h * Vec3{double(random.below(3)) - 1, double(random.below(3)) - 1, 0};
        places.push_back(random.in(box));
        places.push_back(a);
        places.push_back(0.5 * (a + b));
        places.push_back((a + b + a + h * Vec3{0, 1, 0}) / 3);
        const Vec3 out = random.in(box.grown(0.1 * box.diagonal()));
        places.push_back(out);
        places.push_back({half(out.x), half(out.y), half(out.z)});
        places.push_back({half(out.x), out.y, half(out.z)});
    }
    return places;
}

double off_mean(const Weights& weights, const std::vector<Vec3>& sites, const Vec3& q) {
    Vec3 mean;
    for (const auto& [site, weight] : weights.terms) {
        mean = mean + weight * (sites[site] - q);
    }
    return length(mean);
}

CompactDelaunay mesh_of(const std::vector<Vec3>& sites) {
    std::vector<Vec3> sorted;
    for (const std::uint32_t i : morton_order(sites)) {
        sorted.push_back(sites[i]);
    }
    return CompactDelaunay(sorted);
}

}  // namespace

TEST_CASE("E3: among lattices, planes, lines and layers hardly a place needs more than doubles") {
    for (const Shape& shape : shapes()) {
        CAPTURE(shape.name);
        const NaturalNeighbour estimator(shape.sites, nullptr);
        const auto places = places_of(shape, 700);
        std::size_t fallbacks = 0;
        for (const Weights& weights : weights_at(estimator, places)) {
            fallbacks += weights.fallback;
        }
        CHECK(fallbacks <= places.size() / 50);
    }
}

TEST_CASE("E3: where doubles fail long doubles or wide floats do nearly always, and never is an estimate simplified") {
    std::size_t ways[5] = {};
    for (const Shape& shape : shapes()) {
        CAPTURE(shape.name);
        const CompactDelaunay mesh = mesh_of(shape.sites);
        Cavity cavity;
        Random random(6);
        std::vector<double> shares;
        for (int i = 0; i < 60; ++i) {
            // A hair off sites, planes and spheres.
            const double hair = shape.step * std::pow(10.0, random(-13, -6));
            const Vec3 q = shape.sites[random.below(shape.sites.size())] +
                           hair * Vec3{random(-1, 1), random(-1, 1), i % 3 == 0 ? 0 : random(-1, 1)};
            const auto at = mesh.locate(q, mesh.start_near(q));
            const auto& corners = mesh.cells()[static_cast<std::size_t>(at.cell)].vertex;
            if (std::any_of(corners.begin(), corners.end(),
                            [&](std::int32_t v) { return mesh.points()[static_cast<std::size_t>(v)] == q; })) {
                continue;
            }
            cavity.find(mesh, q, at);
            ++ways[static_cast<std::size_t>(fallback_shares(mesh, cavity, q, sibson, shares))];
            CHECK(std::accumulate(shares.begin(), shares.end(), 0.0) == Approx(1));
            std::vector<double> precise;
            REQUIRE(precise_shares(mesh, cavity, q, sibson, precise));
            for (std::size_t v = 0; v < shares.size(); ++v) {
                REQUIRE(std::abs(shares[v] - precise[v]) <= 1e-8);  // cells are thousands of times taller than wide
            }
        }
    }
    CHECK(ways[0] > 200);
    CHECK(ways[2] <= 5);
    CHECK(ways[3] + ways[4] == 0);
}

TEST_CASE("E3: a zone too large for one way goes on to the next, down to barycentric coordinates, all of them linear") {
    const auto sites = square_sites(40, 10);
    const CompactDelaunay mesh = mesh_of(sites);
    const Vec3 q{203, 171, 30};
    Cavity cavity;
    cavity.find(mesh, q, mesh.locate(q, mesh.start_near(q)));
    REQUIRE(cavity.cells.size() > 300);
    const auto with = [&](const FallbackLimits& limits, SharesFrom expected) {
        std::vector<double> shares;
        CHECK(fallback_shares(mesh, cavity, q, sibson, shares, limits) == expected);
        REQUIRE(shares.size() == cavity.vertices.size());
        Vec3 mean;
        for (std::size_t v = 0; v < shares.size(); ++v) {
            REQUIRE(shares[v] >= 0);
            mean = mean + shares[v] * cavity.points[v];
        }
        CHECK(std::accumulate(shares.begin(), shares.end(), 0.0) == Approx(1).epsilon(1e-12));
        CHECK(length(mean) <= 1e-8);
    };
    with({}, SharesFrom::long_doubles);
    with({.long_doubles = 0}, SharesFrom::wide);
    with({.long_doubles = 0, .wide = 0}, SharesFrom::laplace);  // too large for precise floats
    with({.long_doubles = 0, .wide = 0, .precise = 0, .laplace = 0}, SharesFrom::barycentric);
}

TEST_CASE("E3: no shape of samples ends in a signal, with any natural estimator, with an anisotropy or without") {
    auto all = shapes();
    all.push_back({"one sphere", cospherical_sites(1001), 20});
    all.push_back({"square of 2,500", square_sites(50, 10), 10});
    all.push_back({"two sites", {{0, 0, 0}, {1, 0, 0}}, 1});
    for (const Shape& shape : all) {
        const Box3 box = bounding_box(shape.sites);
        for (const char* spec :
             {"natural", "natural:smooth", "laplace", "linear", "natural:azimuth=30:dip=20:ratio3=0.2",
              "laplace:ratio3=0.1", "linear:azimuth=45:ratio2=0.5"}) {
            CAPTURE(shape.name, spec);
            const auto estimator = make_estimator(parse_estimator(spec), shape.sites, nullptr);
            auto places = places_of(shape, 140);
            for (const double below : {4.0, 40.0, 200.0}) {  // on planes of symmetry, and in conflict with thousands
                places.push_back({box.lo.x, box.lo.y, box.lo.z - below * shape.step / 10});
                places.push_back(box.center() - Vec3{0, 0, box.size().z / 2 + below * shape.step / 10});
            }
            const auto weights = weights_at(*estimator, places);
            double worst_sum = 0, worst_mean = 0;
            for (std::size_t i = 0; i < places.size(); ++i) {
                REQUIRE(!weights[i].terms.empty());
                double sum = 0;
                for (const auto& term : weights[i].terms) {
                    sum += term.weight;
                }
                worst_sum = std::max(worst_sum, std::abs(sum - 1));
                if (weights[i].lever == Vec3{}) {
                    worst_mean = std::max(worst_mean, off_mean(weights[i], shape.sites, places[i]));
                }
            }
            CHECK(worst_sum <= 1e-12);
            CHECK(worst_mean <= 1e-6 * box.diagonal());
        }
    }
}
