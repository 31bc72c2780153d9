// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>

#include "tess/build.hpp"
#include "tess/edit/vertex_demand.hpp"
#include "tess/error.hpp"
#include "tess/site/site_box.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;

namespace {

/// Loose samples of one property.
Site site_of(const std::vector<Vec3>& places) {
    Site site;
    site.properties = {{"K", "", Scale::linear, Kind::continuous, {}}};
    site.samples.values.resize(1);
    for (const Vec3& p : places) {
        site.samples.positions.push_back(p);
        site.samples.borehole.push_back(-1);
        site.samples.depth.push_back(0);
        site.samples.length.push_back(0);
        site.samples.values[0].push_back(p.z);
    }
    return site;
}

std::vector<Vec3> places_in(const Box3& box, int count) {
    testing::Random random(7);
    std::vector<Vec3> places;
    for (int i = 0; i < count; ++i) {
        places.push_back(random.in(box));
    }
    return places;
}

const Box3 block{{500000, 6000000, -400}, {501000, 6001000, 0}};

BuildReport built(Site site, const BuildOptions& options, Model& model) {
    BuildReport report;
    model = std::move(build(std::move(site), options, testing::analytic_field(), report)->model);
    return report;
}

}  // namespace

TEST_CASE("A sample a million kilometres off and a collar at the origin set no default, and are named") {
    Site site = site_of(places_in(block, 40));
    BuildOptions options;
    options.criteria.l_min = 100;
    Model plain;
    built(site, options, plain);

    site.samples.positions.push_back({500500, 6000500, 1e9});
    site.samples.borehole.push_back(-1);
    site.samples.depth.push_back(0);
    site.samples.length.push_back(0);
    site.samples.values[0].push_back(0);
    site.boreholes.push_back({"D1", {0, 0, 0}, {{0, 0, 0}}, {0}});
    const SiteBox box = site_box(site, 1);
    REQUIRE(box.far_off.size() == 2);
    CHECK(box.far_off[1].name == "hole 'D1'");
    CHECK(box.far_off[1].distance == Approx(6.02e6).epsilon(0.01));
    Model model;
    const BuildReport report = built(site, options, model);
    CHECK(model.domain.extent == plain.domain.extent);
    REQUIRE(report.diagnostics.notes.size() == 3);
    CHECK_THAT(report.diagnostics.notes[2], Catch::Contains("explains"));  // values that are not the field's
    CHECK_THAT(report.diagnostics.notes[1],
               Catch::Contains("hole 'D1'") && Catch::Contains("6021 km") && Catch::Contains("no coordinates?"));
    CHECK(report.outside_extent == 1);

    options.criteria.l_min = 0;  // a hundredth of the diagonal without them
    built(site, options, model);
    CHECK(model.criteria.l_min < 16);
}

TEST_CASE("Neither a regional site's outposts nor two parts of one site are far off") {
    std::vector<Vec3> places = places_in(block, 30);
    for (int i = 0; i < 8; ++i) {
        places.push_back({500000.0 + 90000 * i, 6000000, -100});  // the farthest, less than a quarter, 630 km away
    }
    CHECK(site_box(site_of(places), 1).far_off.size() == 6);  // 100 km away, and a hundred times as far as the others
    for (int i = 0; i < 8; ++i) {
        places.push_back({500000.0, 6000000.0 + 9000 * i, -100});  // but not a hundred times as far as these
    }
    CHECK(site_box(site_of(places), 1).far_off.empty());
    places = places_in(block, 20);
    for (const Vec3& p : places_in({{900000, 6000000, -400}, {901000, 6001000, 0}}, 20)) {
        places.push_back(p);
    }
    CHECK(site_box(site_of(places), 1).far_off.empty());
    CHECK(site_box(site_of({{0, 0, 0}, {1e8, 0, 0}}), 1).far_off.empty());
}

TEST_CASE("Data flatter than ten to one are stretched to five to one; a level plane and a plumb line are not") {
    CHECK(suitable_z_scale({{0, 0, 0}, {50000, 50000, 200}}) == 50);
    CHECK(suitable_z_scale({{0, 0, 0}, {1000, 1000, 100}}) == 1);
    CHECK(suitable_z_scale({{0, 0, 0}, {1000, 1000, 99}}) == 2);
    CHECK(suitable_z_scale({{0, 0, 0}, {1170, 1170, 100}}) == 2.3);
    CHECK(suitable_z_scale({{0, 0, 5}, {1000, 1000, 5}}) == 1);
    CHECK(suitable_z_scale({{0, 0, 5}, {1000, 1000, 5.0005}}) == 1);  // level but for rounding
    CHECK(suitable_z_scale({{0, 0, 0}, {0, 0, 300}}) == 1);
    CHECK(suitable_z_scale({}) == 1);
    CHECK(suitable_z_scale({{0, 0, 0}, {50000, 50000, 1}}) == 1000);
}

TEST_CASE("The extent is padded by l_max in plan, vertically by a quarter of the height between l_min and l_max") {
    BuildOptions options;
    options.criteria.l_min = 50;
    options.criteria.l_max = 200;
    Model model;
    const auto vertical = [&](double height) {
        built(site_of({{0, 0, -height}, {1000, 1000, 0}, {500, 300, -height / 2}}), options, model);
        CHECK(model.domain.extent.lo.x == -200);
        CHECK(model.domain.extent.hi.y == 1200);
        CHECK(model.domain.extent.lo.z == -height - model.domain.extent.hi.z);
        return model.domain.extent.hi.z;
    };
    CHECK(vertical(400) == 100);
    CHECK(vertical(2000) == 200);
    CHECK(vertical(120) == 50);
    CHECK(vertical(0) == 200);
    const Site small = site_of({{0, 0, -40}, {300, 400, 0}, {50, 30, -20}});
    for (const double l_max : {400.0, 5000.0}) {  // half the data's diagonal is enough: the rest would be padding
        options.criteria.l_max = l_max;
        built(small, options, model);
        CHECK(model.domain.extent.lo.x == Approx(-std::hypot(300, 400, 40) / 2).epsilon(1e-6));
        CHECK(model.domain.extent.hi.z == 50);
    }
    options.pad = 30;
    built(site_of({{0, 0, -400}, {1000, 1000, 0}, {500, 300, -200}}), options, model);
    CHECK(model.domain.extent == Box3{{-30, -30, -430}, {1030, 1030, 30}});
}

TEST_CASE("More vertices than allowed are refused before any is made, naming the option and what may fit") {
    Site site = site_of(places_in(block, 40));
    BuildOptions options;
    options.criteria.l_min = 0.001;
    options.criteria.l_max = 0.004;
    options.refine.max_vertices = 10'000'000;
    Model model;
    CHECK_THROWS_AS(built(site, options, model), UsageError);
    CHECK_THROWS_WITH(built(site, options, model),
                      Catch::Contains("`l_max` of") && Catch::Contains("`max_vertices` 10000000"));

    options.criteria = {};
    options.criteria.l_min = 100;
    site.surfaces = {testing::planar_fault("F", {500500, 6000500, -200}, 30, 70, 400, 200, 40)};
    options.barriers.spacing = 0.01;
    CHECK_THROWS_WITH(built(site, options, model), Catch::Contains("`barriers.spacing` of"));
}

TEST_CASE("What is known of the vertices beforehand is never more than comes of them") {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        testing::World world = testing::random_world(seed);
        INFO(world.description);
        const testing::Built plain = testing::build_world(world);
        world.options.refine.max_vertices = plain.model.vertices.size() + plain.report.refine.removed + 20;  // tried
        CHECK_NOTHROW(testing::build_world(world));
        const auto seeds = std::ranges::count(plain.model.vertices, Role::seed, &Vertex::role);
        CHECK(vertex_demand(plain.model, world.options.barriers).seeds <= static_cast<double>(seeds));
    }
}
