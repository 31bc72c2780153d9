// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/site_mesh.hpp"

#include <catch2/catch.hpp>

#include "estimation.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/natural/cavity.hpp"
#include "interp/natural/linear_precision.hpp"
#include "interp/plan/extrapolation.hpp"
#include "interp/plan/make_estimator.hpp"
#include "regular_sites.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

/// Cells and facets of the places' conflict zones that are looked at one by one, what an estimate's time goes into.
double mean_zone(const std::vector<Vec3>& sites, const std::vector<Vec3>& places) {
    const SiteMesh mesh(sites, nullptr);
    Cavity cavity;
    Weights on_site;
    double size = 0;
    for (const Vec3& place : places) {
        const SiteQuery query = mesh.query(place);
        std::int32_t start = mesh.start_near(place);
        const auto at = mesh.locate(query, start, on_site);
        if (at.cell >= 0) {
            cavity.find(mesh.tessellation(), query.within, at);
            size += static_cast<double>(cavity.cells.size() + cavity.facets.size());
        }
    }
    return size / static_cast<double>(places.size());
}

}  // namespace

TEST_CASE("E3: among samples on lattices, planes, lines and spheres zones are hardly larger than among jittered ones") {
    for (const std::size_t count : {1'000, 20'000}) {
        for (const auto& [name, sites, limit] : regular_sites(count)) {
            const auto places = places_around(sites, 600);
            const double regular = mean_zone(sites, places), irregular = mean_zone(jittered(sites), places);
            CAPTURE(name, count, regular, irregular);
            CHECK(regular <= limit * irregular);
        }
    }
}

TEST_CASE("E3: among samples on a tilted plane or line zones are hardly larger than among jittered ones") {
    for (const auto& [name, sites, limit] : regular_sites(10'000)) {
        if (name != "plane" && name != "line") {
            continue;
        }
        auto places = tilted(places_around(sites, 300));
        const auto in_box = places_in(bounding_box(tilted(sites)), 300, 7);  // most of them far from a plane
        places.insert(places.end(), in_box.begin(), in_box.end());
        const double regular = mean_zone(tilted(sites), places), irregular = mean_zone(tilted(jittered(sites)), places);
        CAPTURE(name, regular, irregular);
        CHECK(regular <= limit * irregular);
    }
}

TEST_CASE("Around samples on a tilted plane or line places have shares of a place of it, and samples their own") {
    Random random(8);
    std::vector<Vec3> triangle, line;
    for (int i = 0; i < 300; ++i) {
        const double u = random(), v = random();
        triangle.push_back({1000 * std::min(u, v), 1000 * std::max(u, v), 0});
        line.push_back({1000 * u, 0, 0});
    }
    const Vec3 origin = tilted({{0, 0, 0}})[0], along_line = tilted({{1, 0, 0}})[0] - origin,
               normal = tilted({{0, 0, 1}})[0] - origin;
    for (const bool on_line : {false, true}) {
        const auto sites = tilted(on_line ? line : triangle);
        const SiteMesh mesh(sites, nullptr);
        for (const Vec3& site : sites) {
            CHECK(mesh.query(site).within == site);
        }
        for (const Vec3& place : places_in(bounding_box(sites).grown(700), 500, 9)) {
            const Vec3 within = mesh.query(place).within, d = within - origin;
            CHECK(mesh.tessellation().within_reach(within));
            CHECK((on_line ? length(cross(d, along_line)) : std::abs(dot(d, normal))) < 1e-4);
        }
    }
}

TEST_CASE("E3: beyond a plane of samples the zones do not grow with the plane") {
    const auto zone_beyond = [](int side) {
        const auto sites = square_sites(side, 10);
        return mean_zone(sites, places_in(bounding_box(sites).grown(40), 500, 6));
    };
    CHECK(zone_beyond(200) <= 1.1 * zone_beyond(50));
}

TEST_CASE("Across the faces of the samples' box estimates are continuous, slopes included") {
    const auto sites = borehole_sites(30, 30, 4);
    std::vector<double> values;
    for (const Vec3& p : sites) {
        values.push_back(p.z + 100 * std::sin(p.x / 200));
    }
    const Box3 box = bounding_box(sites);
    const ColumnTraits traits = traits_of(values, 300);
    for (const char* spec :
         {"natural", "natural:smooth", "laplace", "linear", "natural:azimuth=30:dip=20:ratio3=0.2"}) {
        CAPTURE(spec);
        const auto estimator = make_estimator(parse_estimator(spec), sites, nullptr);
        const auto slopes = estimator->slopes({values});
        // Across the box of an anisotropy's coordinates, wherever that is, goes one of many steps.
        Random random(9);
        double largest = 0;
        std::size_t steps = 0;
        for (int line = 0; line < 40; ++line) {
            const Vec3 inside = random.in(box);
            const Vec3 outside = box.center() + 1.5 * (random.in(box.grown(300)) - box.center());
            // Bisected for where it changes most.
            const auto value = [&](double t) {
                const auto w = weights_at(*estimator, {inside + t * (outside - inside)}).front();
                const double plain = weighted_mean(w.terms, values);
                return plain +
                       made_up(plain, w, extrapolation_at(w.distance, traits.reach), slopes.get(), 0, traits).value;
            };
            double begin = 0, end = 1;
            for (int half = 0; half < 40; ++half, ++steps) {
                const double middle = 0.5 * (begin + end);
                const double at_middle = value(middle);
                (std::abs(at_middle - value(begin)) > std::abs(value(end) - at_middle) ? end : begin) = middle;
            }
            largest = std::max(largest, std::abs(value(end) - value(begin)));
        }
        CHECK(largest <= 1e-5);
        CHECK(steps == 1600);
    }
}

TEST_CASE("E2: beyond the samples' box linear fields go on exactly up to an extrapolation of 0.5") {
    const auto sites = uniform_sites(1500, 11);
    const auto plane = [](const Vec3& p) { return 5 + p.x - 2 * p.y + 0.5 * p.z; };
    std::vector<double> values;
    for (const Vec3& p : sites) {
        values.push_back(plane(p));
    }
    const ColumnTraits traits{-1e9, 1e9, 200};
    const Box3 box = bounding_box(sites);
    for (const char* spec : {"natural", "natural:smooth", "laplace", "linear"}) {
        CAPTURE(spec);
        const auto estimator = make_estimator(parse_estimator(spec), sites, nullptr);
        const auto slopes = estimator->slopes({values});
        std::size_t beyond = 0;
        double worst = 0;
        for (const Vec3& place : places_in(box.grown(120), 600, 12)) {
            const auto w = weights_at(*estimator, {place}).front();
            if (box.contains(place) || w.distance > traits.reach) {
                continue;
            }
            ++beyond;
            const double plain = weighted_mean(w.terms, values);
            const double e = extrapolation_at(w.distance, traits.reach);
            worst =
                std::max(worst, std::abs(plain + made_up(plain, w, e, slopes.get(), 0, traits).value - plane(place)));
        }
        CHECK(beyond > 200);
        CHECK(worst <= 1e-9 * 3500);
    }
}
