// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/estimated_accuracy.hpp"

#include <catch2/catch.hpp>

using namespace terratet;
using namespace terratet::testing;

TEST_CASE("With values estimated from few wells the error is the estimator's, whatever the mesh") {
    AnalyticSite site = thin_layer(6);
    site.options.refine.clean_up = false;
    const EstimatedSite built(site);
    const MeshField own = field_of(built.model());
    const auto places = probes(site.options.extent, 50'000);
    std::vector<double> off = built.estimates(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
        off[i] -= site.field(places[i]);
    }
    const double estimator = root_mean_square(off);
    const double error = root_mean_square(errors(own, site, places));
    const double grid = root_mean_square(errors(built.estimated(uniform_grid(site, own.values.size())), site, places));
    BuildReport report;
    const double by_formula = root_mean_square(errors(adaptive(site, report), site, places));
    CHECK(error == Approx(estimator).epsilon(0.25));
    CHECK(grid < 2 * error);
    CHECK(by_formula < error / 3);
}
