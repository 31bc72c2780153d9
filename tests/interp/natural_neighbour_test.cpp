// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/natural_neighbour.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "estimation.hpp"
#include "interp/natural/cavity.hpp"
#include "interp/sites/compact_delaunay.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/base/morton.hpp"
#include "natural_neighbour_oracle.hpp"
#include "sites.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

double sum_of(const Weights& weights) {
    double sum = 0;
    for (const auto& term : weights.terms) {
        sum += term.weight;
    }
    return sum;
}

Vec3 mean_of(const Weights& weights, const std::vector<Vec3>& sites, const Vec3& from) {
    Vec3 mean;
    for (const auto& [site, weight] : weights.terms) {
        mean = mean + weight * (sites[site] - from);
    }
    return mean;
}

/// Random places and the awkward ones: sites, a hair off sites, and middles of 2, 3 and 4 sites, which on lattices are
/// edges, facets and centres of tied cells.
std::vector<Vec3> places_among(const std::vector<Vec3>& sites, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    const Box3 box = bounding_box(sites);
    const auto site = [&] { return sites[random.below(sites.size())]; };
    const auto near = [&](const Vec3& p) {
        Vec3 best = sites.front() == p ? sites.back() : sites.front();
        for (int i = 0; i < 60; ++i) {
            const Vec3 q = site();
            if (q != p && squared_distance(p, q) < squared_distance(p, best)) {
                best = q;
            }
        }
        return best;
    };
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 a = site();
        const Vec3 b = near(a);
        const Vec3 c = near(a);
        const double hair = 1e-14 * std::max(1.0, length(a));
        places.push_back(random.in(box));
        places.push_back(a);
        places.push_back(a + Vec3{hair, 0, -hair});
        places.push_back(0.5 * (a + b));
        places.push_back((a + b + c) / 3);
        places.push_back(0.25 * (a + b + c + near(c)));
    }
    return places;
}

/// A lattice of cubes of edge 10, as many a side.
std::vector<Vec3> tens(int n) {
    auto sites = lattice_sites(n);
    for (auto& p : sites) {
        p = 10.0 * p;
    }
    return sites;
}

/// Places exactly on the circumsphere of a cube of tens(n), but not inside it: 7² + 5² + 1² = 3·5². All of them also
/// lie on planes of its facets.
std::vector<Vec3> tied_places(int n) {
    std::vector<Vec3> places;
    for (const Vec3& corner : lattice_sites(n)) {
        const Vec3 center = 10.0 * corner + Vec3{5, 5, 5};
        for (const Vec3& d : {Vec3{7, 5, 1}, Vec3{-1, 7, 5}, Vec3{5, -1, -7}, Vec3{-7, -5, 1}, Vec3{1, -5, 7}}) {
            places.push_back(center + d);
        }
    }
    std::erase_if(places, [n](const Vec3& p) {
        return !Box3{{11, 11, 11}, {10. * n - 21, 10. * n - 21, 10. * n - 21}}.contains(p);
    });
    return places;
}

std::vector<std::pair<std::string, std::vector<Vec3>>> families() {
    return {{"uniform", uniform_sites(2000)},
            {"400 wells of 250 samples", borehole_sites(400, 250)},
            {"lattice", lattice_sites(10)},
            {"lattice of tens", tens(7)},
            {"one sphere", cospherical_sites(101)}};
}

/// Half-integer places of a lattice of n³ sites: centres, faces and edges of its cubes, and sites.
std::vector<Vec3> half_points(int n) {
    std::vector<Vec3> places = lattice_sites(2 * n - 1);
    for (auto& p : places) {
        p = 0.5 * p;
    }
    return places;
}

bool identical(const Weights& a, const Weights& b) {
    return a.beyond == b.beyond && a.fallback == b.fallback &&
           std::equal(
               a.terms.begin(), a.terms.end(), b.terms.begin(), b.terms.end(),
               [](const SiteWeight& x, const SiteWeight& y) { return x.site == y.site && x.weight == y.weight; });
}

}  // namespace

TEST_CASE("Natural neighbour weights sum to 1, are not negative and give the query as the mean of its neighbours") {
    for (const auto& [name, sites] : families()) {
        CAPTURE(name);
        const NaturalNeighbour estimator(sites, nullptr);
        std::vector<Vec3> sorted;
        for (const std::uint32_t i : morton_order(sites)) {
            sorted.push_back(sites[i]);
        }
        const CompactDelaunay mesh(sorted);
        auto places = places_among(sites, 1000, 7);
        if (name == "lattice") {
            const auto halves = half_points(10);
            places.insert(places.end(), halves.begin(), halves.end());
        }
        if (name == "lattice of tens") {
            const auto tied = tied_places(7);
            places.insert(places.end(), tied.begin(), tied.end());
        }
        const auto weights = weights_at(estimator, places);
        double worst_sum = 0, worst_mean = 0, worst_weight = 0;
        std::size_t inside = 0, fallbacks = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            REQUIRE(!weights[i].terms.empty());
            worst_sum = std::max(worst_sum, std::abs(sum_of(weights[i]) - 1));
            for (const auto& term : weights[i].terms) {
                worst_weight = std::min(worst_weight, term.weight);
            }
            fallbacks += weights[i].fallback;
            if (weights[i].beyond == 0) {
                ++inside;
                const auto at = mesh.locate(places[i], mesh.start_near(places[i]));
                const auto& cell = mesh.cells()[static_cast<std::size_t>(at.cell)];
                const double radius = distance(cell.center, mesh.points()[static_cast<std::size_t>(cell.vertex[0])]);
                worst_mean = std::max(worst_mean, length(mean_of(weights[i], sites, places[i])) / radius);
            }
        }
        INFO("inside " << inside << " of " << places.size() << ", fallbacks " << fallbacks << ", sum " << worst_sum
                       << ", mean " << worst_mean);
        CHECK(worst_sum <= 1e-13);
        CHECK(worst_weight >= 0);
        CHECK(worst_mean <= 1e-9);
        CHECK(inside > places.size() / 3);  // a sphere fills half of its box, and near its surface ghosts have a share
        CHECK(fallbacks <= places.size() / 100);
    }
}

TEST_CASE("On a site the weight is that site's alone, and a hair off it nearly so") {
    for (const auto& [name, sites] : families()) {
        CAPTURE(name);
        const NaturalNeighbour estimator(sites, nullptr);
        const auto on = weights_at(estimator, sites);
        std::vector<Vec3> off = sites;
        for (auto& p : off) {
            const double hair = 1e-14 * std::max(1.0, length(p));
            p = p + Vec3{hair, 0, -hair};
        }
        const auto near = weights_at(estimator, off);
        for (std::uint32_t i = 0; i < sites.size(); ++i) {
            REQUIRE(on[i].terms.size() == 1);
            REQUIRE(on[i].terms.front().site == i);
            REQUIRE(on[i].terms.front().weight == 1);
            REQUIRE(on[i].beyond == 0);
            const auto own = std::find_if(near[i].terms.begin(), near[i].terms.end(),
                                          [i](const SiteWeight& term) { return term.site == i; });
            REQUIRE(own != near[i].terms.end());
            REQUIRE(own->weight > 1 - 1e-8);
        }
    }
}

TEST_CASE("Natural neighbour weights equal those of CGAL's sibson_natural_neighbor_coordinates_3") {
    const auto sites = uniform_sites(2000, 11);
    const NaturalNeighbour estimator(sites, nullptr);
    Random random(12);
    std::vector<Vec3> places(1000);
    for (auto& p : places) {
        p = random.in({{150, 150, 150}, {850, 850, 850}});
    }
    const auto own = weights_at(estimator, places);
    const auto cgal = cgal_sibson_weights(sites, places);
    double worst = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        REQUIRE(own[i].beyond == 0);
        worst = std::max(worst, largest_difference(own[i].terms, cgal[i]));
    }
    CHECK(worst <= 1e-9);
}

TEST_CASE("Natural neighbour weights equal exact differences of Voronoi volumes before and after insertion") {
    struct Case {
        std::string name;
        std::vector<Vec3> sites;
        std::vector<Vec3> places;
    };
    std::vector<Case> cases;
    Random random(21);
    const auto inner = [&](const std::vector<Vec3>& sites, std::size_t count) {
        const Box3 box = bounding_box(sites);
        std::vector<Vec3> places(count);
        for (auto& p : places) {
            p = box.center() + 0.6 * (random.in(box)-box.center());
        }
        return places;
    };
    const auto uniform = uniform_sites(400, 22);
    cases.push_back({"uniform", uniform, inner(uniform, 100)});
    const auto wells = borehole_sites(12, 40, 23);
    cases.push_back({"wells", wells, inner(wells, 15)});
    const auto lattice = lattice_sites(6);
    auto lattice_places = inner(lattice, 20);
    for (const Vec3& p : half_points(6)) {
        if (random() < 0.05 && Box3{{1, 1, 1}, {4, 4, 4}}.contains(p) && p.x != std::floor(p.x)) {
            lattice_places.push_back(p);
        }
    }
    cases.push_back({"lattice", lattice, lattice_places});
    auto tied = tied_places(6);
    tied.resize(std::min<std::size_t>(tied.size(), 40));
    cases.push_back({"on spheres", tens(6), tied});
    const auto sphere = cospherical_sites(41);
    cases.push_back({"one sphere", sphere, inner(sphere, 10)});
    // Tenths are no doubles: cells of rounding errors' volume between the tied ones.
    auto tenths = lattice_sites(6);
    for (auto& p : tenths) {
        p = 0.1 * p;
    }
    cases.push_back({"lattice of tenths", tenths, inner(tenths, 20)});

    std::size_t compared = 0;
    for (const auto& [name, sites, places] : cases) {
        CAPTURE(name);
        const NaturalNeighbour estimator(sites, nullptr);
        const auto own = weights_at(estimator, places);
        const ExactVoronoi exact(sites);
        double worst = 0, worst_long = 0, worst_wide = 0, worst_precise = 0;
        std::size_t given_up = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (own[i].beyond > 0) {
                continue;
            }
            ++compared;
            const auto expected = exact.sibson_weights(places[i]);
            worst = std::max(worst, largest_difference(own[i].terms, expected));
            // The fallbacks' answers, asked for everywhere.
            const auto off = [&](Fallback which) {
                const auto weights = fallback_weights(sites, places[i], which);
                given_up += weights.empty() && which == Fallback::wide;
                REQUIRE((which != Fallback::precise || !weights.empty()));
                return weights.empty() ? 0 : largest_difference(weights, expected);
            };
            worst_long = std::max(worst_long, off(Fallback::long_doubles));
            worst_wide = std::max(worst_wide, off(Fallback::wide));
            worst_precise = std::max(worst_precise, off(Fallback::precise));
        }
        CHECK(worst <= 1e-9);
        CHECK(worst_long <= 1e-11);
        CHECK(worst_wide <= 1e-14);
        CHECK(worst_precise <= 1e-14);
        CHECK((given_up == 0 || name == "lattice of tenths"));  // flat cells there are too much for them
    }
    CHECK(compared >= 200);
}

TEST_CASE("A conflict zone found by groups of cells is the zone, and its sums are the weights") {
    // Four dense, leaning wells: between two of them lie as many cells as the product of their samples.
    std::vector<Vec3> sites;
    for (int w = 0; w < 4; ++w) {
        const Vec3 collar{100. * (w % 2), 110. * (w / 2), 0};
        const Vec3 lean{0.05 * (w - 1), 0.08 * (w == 2) - 0.03, -1};
        for (int i = 0; i < 400; ++i) {
            sites.push_back(collar + double(i) * lean + Vec3{0, 0, 0.01 * ((7 * i) % 5)});
        }
    }
    std::vector<Vec3> sorted;
    for (const std::uint32_t i : morton_order(sites)) {
        sorted.push_back(sites[i]);
    }
    const CompactDelaunay mesh(sorted);
    const NaturalNeighbour estimator(sites, nullptr);
    Random random(81);
    std::size_t by_groups = 0;
    for (int i = 0; i < 60; ++i) {
        const Vec3 q = random.in(bounding_box(sites).grown(i % 2 ? 40 : 0));
        Cavity cavity;
        cavity.find(mesh, q, mesh.locate(q, mesh.start_near(q)));
        by_groups += !cavity.groups.empty();
        auto found = cavity.all_cells(mesh);
        std::sort(found.begin(), found.end());
        std::vector<std::int32_t> expected;
        for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
            if (mesh.in_conflict(mesh.cells()[c], q)) {
                expected.push_back(static_cast<std::int32_t>(c));
            }
        }
        REQUIRE(found == expected);
        REQUIRE(cavity.facets.size() == 2 * cavity.vertices.size() - 4);  // its boundary is a sphere
        if (i < 4 && i % 2 == 0) {  // within the sites' box, or its nearest place would be asked for
            auto own = weights_at(estimator, {q}).front();
            REQUIRE(!own.fallback);
            for (auto& term : own.terms) {
                term.weight *= 1 - own.beyond;  // as before the ghosts' share was left out
            }
            REQUIRE(largest_difference(own.terms, fallback_weights(sites, q, Fallback::precise)) <= 1e-9);
        }
    }
    CHECK(by_groups > 20);
}

TEST_CASE("Linear fields are reproduced inside the hull") {
    for (const auto& [name, sites] : families()) {
        CAPTURE(name);
        const Box3 box = bounding_box(sites);
        const double scale = 1 / box.diagonal();
        const auto field = [&](const Vec3& p) { return 2 + scale * (p.x - 0.7 * p.y + 0.3 * p.z); };
        const NaturalNeighbour estimator(sites, nullptr);
        const auto places = places_among(sites, 500, 31);
        const auto weights = weights_at(estimator, places);
        double worst = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (weights[i].beyond > 0) {
                continue;
            }
            double value = 0;
            for (const auto& [site, weight] : weights[i].terms) {
                value += weight * field(sites[site]);
            }
            worst = std::max(worst, std::abs(value - field(places[i])));
        }
        CHECK(worst <= 1e-10);
    }
}

TEST_CASE(
    "R6: natural neighbour weights have the same bits at any thread count and in any order of queries and sites") {
    for (const auto& [name, sites] : families()) {
        CAPTURE(name);
        const auto places = places_among(sites, 300, 41);
        const NaturalNeighbour estimator(sites, nullptr);
        const auto weights_with = [&](std::size_t threads) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            return weights_at(estimator, places);
        };
        const auto one = weights_with(1);
        const auto four = weights_with(4);
        for (std::size_t i = 0; i < places.size(); ++i) {
            REQUIRE(identical(one[i], four[i]));
        }

        std::vector<std::uint32_t> order(places.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        order = shuffled(order, 42);
        for (const std::uint32_t i : order) {  // one at a time, from elsewhere each
            REQUIRE(identical(one[i], weights_at(estimator, {places[i]}).front()));
        }

        std::vector<std::uint32_t> rows(sites.size());
        for (std::uint32_t i = 0; i < rows.size(); ++i) {
            rows[i] = i;
        }
        rows = shuffled(rows, 43);
        std::vector<Vec3> permuted;
        for (const std::uint32_t row : rows) {
            permuted.push_back(sites[row]);
        }
        auto other = weights_at(NaturalNeighbour(permuted, nullptr), places);
        for (std::size_t i = 0; i < places.size(); ++i) {
            for (auto& term : other[i].terms) {
                term.site = rows[term.site];
            }
            REQUIRE(identical(one[i], other[i]));
        }
    }
}

TEST_CASE("Random queries hardly ever need exact arithmetic") {
    for (const auto& sites : {uniform_sites(5000, 51), borehole_sites(100, 100, 52)}) {
        Random random(53);
        std::vector<Vec3> places(20'000);
        for (auto& p : places) {
            p = random.in({{0, 0, 0}, {side, side, side}});
        }
        std::size_t fallbacks = 0;
        for (const auto& weights : weights_at(NaturalNeighbour(sites, nullptr), places)) {
            fallbacks += weights.fallback;
        }
        CHECK(fallbacks < places.size() / 1000);
    }
}

TEST_CASE("Few, collinear and coplanar sites give the answers symmetry asks for") {
    const auto at = [](const std::vector<Vec3>& sites, const Vec3& q) {
        return weights_at(NaturalNeighbour(sites, nullptr), {q}).front();
    };
    SECTION("one site is everything everywhere") {
        const auto near = at({{5, 5, 5}}, {5.5, 5, 5});
        REQUIRE(near.terms.size() == 1);
        CHECK(near.terms[0].weight == 1);
        CHECK(near.distance == 0.5);
        const auto far = at({{5, 5, 5}}, {500, 5, 5});
        REQUIRE(far.terms.size() == 1);
        CHECK(far.terms[0].weight == 1);
        CHECK(far.distance == 495);
    }
    SECTION("between two sites both count the same") {
        const auto w = at({{0, 0, 0}, {2, 0, 0}}, {1, 0, 0});
        REQUIRE(w.terms.size() == 2);
        CHECK(w.terms[0].weight == Approx(0.5).margin(1e-12));
        const auto off = at({{0, 0, 0}, {2, 0, 0}}, {0.5, 0, 0});
        REQUIRE(off.terms.size() == 2);
        CHECK(mean_of(off, {{0, 0, 0}, {2, 0, 0}}, {0, 0, 0}).x == Approx(0.5).margin(0.05));
    }
    SECTION("in the middle of a triangle, a square and a tetrahedron") {
        const double h = std::sqrt(3.0) / 2;
        for (const auto& w : {at({{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}}, {0.5, h / 3, 0}),
                              at({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}}, {1, 1, 0}),
                              at({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {0, 0, 0})}) {
            for (const auto& term : w.terms) {
                // The ghosts' cube shares only the symmetry of the last two.
                CHECK(term.weight == Approx(1.0 / static_cast<double>(w.terms.size())).margin(4e-2));
            }
        }
    }
    SECTION("along a line of sites only the two next to the query count") {
        std::vector<Vec3> line;
        for (int i = 0; i < 10; ++i) {
            line.push_back({i + 0.0, 2.0 * i, -i + 0.0});
        }
        const auto w = at(line, {4.5, 9, -4.5});
        double next = 0;
        for (const auto& term : w.terms) {
            next += term.site == 4 || term.site == 5 ? term.weight : 0;
        }
        CHECK(next > 0.95);
        CHECK(sum_of(w) == Approx(1).margin(1e-13));
    }
    SECTION("however far beyond: what the nearest place of the sites' box has, and the way from there") {
        const auto sites = uniform_sites(50);
        const Vec3 far{1e7, 300, -1e6};
        const auto w = at(sites, far);
        const auto nearest = at(sites, bounding_box(sites).clamped(far));
        REQUIRE(w.terms.size() == nearest.terms.size());
        CHECK(largest_difference(w.terms, nearest.terms) == 0);
        CHECK(length(mean_of(w, sites, far) + w.lever) <= 1e-6);
        CHECK(w.distance > 1e6);
    }
}

TEST_CASE("The ghosts' share is 0 inside and grows outwards, as far as the sites' box goes") {
    const auto sites = uniform_sites(2000, 61);
    std::vector<Vec3> outwards;
    for (int i = 0; i <= 40; ++i) {
        outwards.push_back({500.0 + 100 * i, 510, 490});
    }
    const auto weights = weights_at(NaturalNeighbour(sites, nullptr), outwards);
    CHECK(weights.front().beyond == 0);
    for (std::size_t i = 1; i < weights.size(); ++i) {
        CHECK(weights[i].beyond >= weights[i - 1].beyond);
        CHECK(weights[i].beyond <= 1);
        CHECK(sum_of(weights[i]) == Approx(1).margin(1e-13));
    }
    CHECK(weights.back().beyond > 0);
}
