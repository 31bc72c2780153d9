// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/default_spacing.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tess/barrier_query.hpp"
#include "tests/tess/fault_cases.hpp"

namespace terratet {
namespace {

constexpr double l_min = 1;

/// A site of 100 by 100 by 100 with samples far from x = 50, but for `close` of them, and faults there.
Model site_with(std::vector<Surface> faults, int close = 0) {
    Model model;
    model.domain.extent = model.domain.hull = {{0, 0, 0}, {100, 100, 100}};
    model.criteria.l_min = l_min;
    model.criteria.l_max = 4 * l_min;
    model.surfaces = std::move(faults);
    testing::Random random(3);
    for (int i = 0; i < 100; ++i) {
        const double x = i < close ? 50 + 1.2 : random(0, 40);
        model.samples.positions.push_back({x, random(5, 95), random(5, 95)});
    }
    return model;
}

/// In the middle of the site.
Surface wall(double size = 120, double amplitude = 0) {
    return testing::gridded("wall", amplitude > 0 ? 60 : 6, 6, [=](double u, double v) {
        const double along = (u - 0.5) * size;
        return Vec3{50 + amplitude * std::sin(along * 2 * std::numbers::pi / 8), 50 + along, 50 + (v - 0.5) * size};
    });
}

/// The spacing chosen, 0 for that asked for.
double prepared(Model& model, BuildReport& report, BuildOptions options = {}) {
    options.separate_faults = options.barriers.spacing == 0;
    prepare_boundary_at_default_spacing(options, model, report, {});
    return model.barrier_options.spacing;
}

}  // namespace

TEST_CASE("Where a large fault would take most of the vertices of a site with few samples, its spacing is wider") {
    for (const SeedMode mode : {SeedMode::paired, SeedMode::exact}) {
        INFO((mode == SeedMode::paired ? "paired" : "exact"));
        Model model = site_with({wall()});
        BuildOptions options;
        options.barriers.mode = mode;
        BuildReport report;
        const double spacing = prepared(model, report, options);
        CHECK(spacing > 1.4 * l_min);
        CHECK(spacing <= model.criteria.l_max / std::sqrt(2.0));
        REQUIRE(model.barriers.size() == 1);
        CHECK(model.barriers[0].seeds.size() < 24000 / 2);
        CHECK(report.barriers[0].used);
        CHECK(report.barriers[0].deviation_max < l_min / 8);
        CHECK(model.barrier_options.mode == mode);
    }
}

TEST_CASE("A sample that would stay at L_min stays at the wider spacing as well") {
    Model model = site_with({wall()}, 30);
    BuildReport report;
    CHECK(prepared(model, report) > 1.4 * l_min);
    const BarrierQuery barriers(model.barriers);
    for (const Vec3& p : model.samples.positions) {
        CHECK(barriers.protecting_barrier(p) < 0);
    }
}

TEST_CASE("In exact mode, which makes no room for samples, the spacing is so much less that they stay") {
    BuildOptions options;
    options.barriers.mode = SeedMode::exact;
    for (const bool near : {false, true}) {
        Model model = site_with({wall()}, near ? 30 : 0);
        for (Vec3& p : model.samples.positions) {
            p.x += p.x > 50 ? 0.5 : 0;
        }
        BuildReport report;
        const double widest = model.criteria.l_max / std::sqrt(2.0);
        CHECK(prepared(model, report, options) == Approx(near ? widest / 1.5 : widest));
    }
}

TEST_CASE("The faults' spacing is L_min where a wider one would cost the surface's shape") {
    BuildReport report;
    BuildOptions options;
    options.barriers.mode = SeedMode::exact;  // which keeps bends
    SECTION("flat") {
        Model model = site_with({wall(48)});
        CHECK(prepared(model, report, options) > 1.4 * l_min);
    }
    SECTION("waves") {
        Model model = site_with({wall(48, 1.1)});
        CHECK(prepared(model, report, options) == l_min);
    }
}

TEST_CASE(
    "The faults' spacing is as asked for where they are small, where it is given, and where there are many samples") {
    BuildReport report;
    SECTION("small") {
        Model model = site_with({testing::rectangle("small", {50, 50, 50}, {0, 20, 0}, {0, 0, 20})});
        CHECK(prepared(model, report) == l_min);
    }
    SECTION("given") {
        Model model = site_with({wall()});
        BuildOptions options;
        options.barriers.spacing = 1.5;
        CHECK(prepared(model, report, options) == 1.5);
        CHECK_FALSE(model.barrier_options.refine);
    }
    SECTION("many samples") {
        Model model = site_with({wall()});
        const std::vector<Vec3> few = model.samples.positions;
        for (int i = 1; i < 30; ++i) {
            for (const Vec3& p : few) {
                model.samples.positions.push_back(p + Vec3{0, 0, 0.01 * i});
            }
        }
        CHECK(prepared(model, report) == l_min);
    }
}

}  // namespace terratet
