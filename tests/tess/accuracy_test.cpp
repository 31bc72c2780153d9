// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/accuracy.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace terratet;
using namespace terratet::testing;

namespace {

double rms(const auto& field, const AnalyticSite& site) {
    return root_mean_square(errors(field, site, probes(site.options.extent, 200'000)));
}

/// Coarser than the published table, and without the clean-up: it is for shapes, and the slower part.
AnalyticSite quick(AnalyticSite site) {
    site.options.refine.clean_up = false;
    return site;
}

/// A site in the frame of the others whose field is linear: every method here must have it exactly.
AnalyticSite linear_site() {
    AnalyticSite site = quick(smooth_trend(4));
    site.field = [](const Vec3& p) { return 2 * p.x - p.y + 3 * p.z + 5; };
    for (std::size_t i = 0; i < site.site.samples.size(); ++i) {
        site.site.samples.values[0][i] = site.field(site.site.samples.positions[i]);
    }
    site.options.criteria.variation = {{0, 0}};
    return site;
}

}  // namespace

TEST_CASE("A linear field is exact on the adaptive tessellation, the uniform grid and the uniform mesh") {
    const AnalyticSite site = linear_site();
    BuildReport report;
    const MeshField own = adaptive(site, report);
    const auto largest = [&](const auto& field) {
        double worst = 0;
        for (const double error : errors(field, site, probes(site.options.extent, 20'000))) {
            worst = std::max(worst, std::abs(error));
        }
        return worst;
    };
    CHECK(largest(own) < 1e-8);
    CHECK(largest(uniform_grid(site, own.values.size())) < 1e-8);
    CHECK(largest(uniform_mesh(site, own.values.size())) < 1e-8);
}

TEST_CASE("The errors of uniform grid and mesh fall with the square of their spacing") {
    const AnalyticSite site = smooth_trend(1);
    CHECK(rms(uniform_grid(site, 2'000), site) / rms(uniform_grid(site, 16'000), site) == Approx(4).epsilon(0.15));
    CHECK(rms(uniform_mesh(site, 2'000), site) / rms(uniform_mesh(site, 16'000), site) == Approx(4).epsilon(0.25));
}

TEST_CASE("Where the field varies in a thin layer or along a fault, adapting makes the error five times smaller") {
    for (const AnalyticSite& site : {quick(thin_layer(3)), quick(raised_zone(3))}) {
        BuildReport report;
        const MeshField own = adaptive(site, report);
        const GridField grid = uniform_grid(site, own.values.size());
        const MeshField mesh = uniform_mesh(site, own.values.size());
        INFO(site.name << ", " << own.values.size() << " values; grid " << grid.values.size() << ", mesh "
                       << mesh.values.size());
        const double error = rms(own, site);
        // As many values: the rows of a lattice are whole numbers, so a few per cent remain.
        CHECK(static_cast<double>(grid.values.size()) > 0.9 * static_cast<double>(own.values.size()));
        CHECK(static_cast<double>(mesh.values.size()) > 0.9 * static_cast<double>(own.values.size()));
        CHECK(rms(grid, site) >= 5 * error);
        CHECK(rms(mesh, site) >= 5 * error);
    }
}
