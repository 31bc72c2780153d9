// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// How exact natural neighbour weights are, on places of all kinds among sites of all kinds: against the definition in
/// rational numbers, differences of Voronoi volumes computed from exact circumcentres.
///
///   exactness_bench [PLACES=100000 [COMPARED=2000]]     the numbers a row: places estimated, places recomputed exactly
///                                                       (3 to 70 ms each)

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "interp/natural/cavity.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/natural/exact_volumes.hpp"
#include "interp/base/morton.hpp"
#include "interp/natural/natural_neighbour.hpp"
#include "sites.hpp"
#include "tess/value_source.hpp"

using namespace terratet;

namespace {

/// Random places; sites; a hair off them; middles of 2 and 3 sites (edges and facets); places on the hull's box.
std::vector<Vec3> places_among(const std::vector<Vec3>& sites, std::size_t count) {
    testing::Random random(9);
    const Box3 box = bounding_box(sites);
    std::vector<Vec3> sorted;
    for (const std::uint32_t i : morton_order(sites)) {
        sorted.push_back(sites[i]);
    }
    std::vector<Vec3> places;
    while (places.size() < count) {
        const std::size_t i = random.below(sorted.size() - 2);
        const Vec3 a = sorted[i], b = sorted[i + 1], c = sorted[i + 2];
        const double hair = 1e-14 * std::max(1.0, length(a));
        Vec3 on_box = random.in(box);
        on_box[static_cast<int>(i % 3)] = i % 2 ? box.lo[static_cast<int>(i % 3)] : box.hi[static_cast<int>(i % 3)];
        for (const Vec3& p : {random.in(box), random.in(box), random.in(box), random.in(box), a,
                              a + Vec3{hair, 0, -hair}, 0.5 * (a + b), (a + b + c) / 3, on_box}) {
            places.push_back(p);
        }
    }
    places.resize(count);
    return places;
}

void measure(const char* name, const std::vector<Vec3>& sites, std::size_t count, std::size_t compare) {
    const auto places = places_among(sites, count);
    std::vector<ValueQuery> queries;
    for (const Vec3& p : places) {
        queries.push_back({p});
    }
    std::vector<Weights> weights(count);
    NaturalNeighbour(sites, nullptr).weights(queries, weights);

    const auto order = morton_order(sites);
    std::vector<Vec3> sorted;
    for (const std::uint32_t i : order) {
        sorted.push_back(sites[i]);
    }
    const CompactDelaunay mesh(sorted);
    std::size_t every = std::max<std::size_t>(1, count / compare);
    every += every > 1 && every % 3 == 0 ? 1 : 0;  // no divisor of the pattern of places
    Cavity cavity;
    std::vector<double> exact;
    std::vector<double> difference(sites.size(), 0);
    double worst_mean = 0, worst_weight = 0, least = 0;
    std::size_t fallbacks = 0, random_fallbacks = 0, compared = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3& q = places[i];
        fallbacks += weights[i].fallback;
        random_fallbacks += weights[i].fallback && i % 9 < 4;
        for (const auto& term : weights[i].terms) {
            least = std::min(least, term.weight);
        }
        if (weights[i].terms.size() < 2) {
            continue;  // on a site
        }
        cavity.find(mesh, q, mesh.locate(q, mesh.start_near(q)));
        if (weights[i].beyond == 0) {
            Vec3 mean;
            for (const auto& [site, weight] : weights[i].terms) {
                mean = mean + weight * (sites[site] - q);
            }
            const auto& home = mesh.cells()[static_cast<std::size_t>(cavity.home)];
            worst_mean = std::max(worst_mean, length(mean) / std::sqrt(home.squared_radius));
        }
        if (i % every != 0) {
            continue;
        }
        if (!precise_shares(mesh, cavity, q, Weighting::sibson, exact)) {
            std::abort();
        }
        ++compared;
        double of_sites = 0;
        for (std::size_t v = 0; v < exact.size(); ++v) {
            of_sites += mesh.is_ghost(cavity.vertices[v]) ? 0 : exact[v];
        }
        for (const auto& [site, weight] : weights[i].terms) {
            difference[site] = weight;
        }
        for (std::size_t v = 0; v < exact.size(); ++v) {
            if (!mesh.is_ghost(cavity.vertices[v])) {
                double& d = difference[order[static_cast<std::size_t>(cavity.vertices[v])]];
                worst_weight = std::max(worst_weight, std::abs(d - exact[v] / of_sites));
                d = 0;
            }
        }
    }
    std::printf("| %s | %zu | %.1e | %.1e | %.1e | %zu | %zu |\n", name, compared, worst_mean, worst_weight, least,
                random_fallbacks, fallbacks);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100'000;
    const std::size_t compare = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 2'000;
    std::printf(
        "| sites | places compared | mean of neighbours off, /R | weights off | least weight | fallbacks of the %zu "
        "random | of all %zu |\n|---|---|---|---|---|---|---|\n",
        count / 9 * 4, count);
    measure("10,000 uniform", testing::uniform_sites(10'000), count, compare);
    measure("40 wells x 50", testing::borehole_sites(40, 50), count, compare);
    measure("lattice of 12 x 12 x 12", testing::lattice_sites(12), count, compare);
    measure("168 on one sphere", testing::cospherical_sites(101), count, compare);
}
