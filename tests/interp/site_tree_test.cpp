// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/site_tree.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <numeric>

#include "interp/anisotropy.hpp"
#include "sites.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

/// From the definition: all sites by distance, then by coordinates, each taken unless a limit forbids.
std::vector<std::uint32_t> by_definition(const std::vector<Vec3>& sites, const std::vector<std::int32_t>& boreholes,
                                         const Vec3& q, const Neighbourhood& limits) {
    std::vector<std::uint32_t> order(sites.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](auto a, auto b) {
        const double da = squared_distance(sites[a], q);
        const double db = squared_distance(sites[b], q);
        return da != db ? da < db : sites[a] < sites[b];
    });
    std::map<int, std::uint32_t> octants;
    std::map<int, std::uint32_t> holes;
    std::vector<std::uint32_t> taken;
    for (const std::uint32_t i : order) {
        const Vec3& p = sites[i];
        const int octant = 4 * (p.x >= q.x) + 2 * (p.y >= q.y) + (p.z >= q.z);
        if (taken.size() == limits.max_points || squared_distance(p, q) > limits.radius * limits.radius) {
            break;
        }
        if ((limits.per_octant > 0 && octants[octant] == limits.per_octant) ||
            (limits.per_borehole > 0 && boreholes[i] >= 0 && holes[boreholes[i]] == limits.per_borehole)) {
            continue;
        }
        ++octants[octant];
        ++holes[boreholes[i]];
        taken.push_back(i);
    }
    return taken;
}

void compare(const std::vector<Vec3>& sites, const std::vector<std::int32_t>& boreholes, const Box3& box,
             std::uint64_t seed) {
    const SiteTree tree(sites, boreholes);
    Random random(seed);
    std::vector<NearSite> found;
    const auto usable = [](std::uint32_t) { return true; };
    for (int i = 0; i < 300; ++i) {
        // Every third place is a site, where ties abound on a lattice.
        const Vec3 q = i % 3 == 0 ? sites[random.below(sites.size())] : random.in(box);
        Neighbourhood limits{1 + random.below(40), i % 4 == 0 ? random(0, box.diagonal() / 3) : INFINITY,
                             static_cast<std::uint32_t>(random.below(5)), static_cast<std::uint32_t>(random.below(5))};
        tree.neighbourhood(q, limits, usable, found);
        const auto expected = by_definition(sites, boreholes, q, limits);
        REQUIRE(found.size() == expected.size());
        for (std::size_t k = 0; k < expected.size(); ++k) {
            REQUIRE(found[k].site == expected[k]);
            REQUIRE(found[k].squared_distance == squared_distance(sites[expected[k]], q));
        }
        limits.per_octant = limits.per_borehole = 0;
        tree.nearest(q, limits.max_points, limits.radius * limits.radius, found);
        const auto nearest = by_definition(sites, boreholes, q, limits);
        REQUIRE(found.size() == nearest.size());
        for (std::size_t k = 0; k < nearest.size(); ++k) {
            REQUIRE(found[k].site == nearest[k]);
        }
    }
}

}  // namespace

TEST_CASE("Neighbourhoods are those of the definition: uniform, along boreholes, on a lattice, few") {
    const auto uniform = uniform_sites(2000, 41);
    compare(uniform, std::vector<std::int32_t>(2000, -1), {{-100, -100, -100}, {1100, 1100, 1100}}, 42);
    const auto wells = borehole_sites(12, 150, 43);
    std::vector<std::int32_t> holes;
    for (std::size_t i = 0; i < wells.size(); ++i) {
        holes.push_back(i < 1500 ? static_cast<std::int32_t>(i / 150) : -1);
    }
    compare(wells, holes, {{-500, -500, -500}, {1500, 1500, 1500}}, 44);
    compare(lattice_sites(10), std::vector<std::int32_t>(1000, 7), {{-1, -1, -1}, {10, 10, 10}}, 45);
    compare(uniform_sites(1, 46), {0}, {{0, 0, 0}, {1000, 1000, 1000}}, 47);
    compare(uniform_sites(9, 48), {0, 0, 0, 1, 1, 1, -1, -1, -1}, {{0, 0, 0}, {1000, 1000, 1000}}, 49);
}

TEST_CASE("A neighbourhood's limits are tested before visibility, the dear test") {
    const auto wells = borehole_sites(100, 2000, 50);
    std::vector<std::int32_t> holes;
    for (std::size_t i = 0; i < wells.size(); ++i) {
        holes.push_back(static_cast<std::int32_t>(i / 2000));
    }
    const SiteTree tree(wells, holes);
    std::vector<NearSite> found;
    std::size_t asked = 0;
    std::size_t taken = 0;
    const auto counting = [&](std::uint32_t) { return ++asked, true; };
    Random random(51);
    for (int i = 0; i < 100; ++i) {
        tree.neighbourhood(random.in({{0, 0, 0}, {1000, 1000, 1000}}), {24, INFINITY, 4, 4}, counting, found);
        taken += found.size();
    }
    CHECK(asked == taken);
    CHECK(taken > 2000);
}

TEST_CASE("A neighbourhood looks at no more points than it may, the nearest") {
    const auto sites = uniform_sites(5000, 52);
    const SiteTree tree(sites);
    std::vector<NearSite> found, nearest;
    std::vector<std::uint32_t> asked;
    const auto refusing = [&](std::uint32_t i) { return asked.push_back(i), false; };
    tree.neighbourhood({400, 500, 600}, {.max_looked_at = 70}, refusing, found);
    tree.nearest({400, 500, 600}, 70, INFINITY, nearest);
    REQUIRE(asked.size() == nearest.size());
    for (std::size_t i = 0; i < asked.size(); ++i) {
        CHECK(asked[i] == nearest[i].site);
    }
    CHECK(found.empty());
}

TEST_CASE("Anisotropy turns and stretches as GSLIB does") {
    const Metric plain{{}};
    const Vec3 p{3, -4, 5};
    CHECK(plain(p) == p);
    // Vertical exaggeration: ranges ten times shorter along z.
    const Metric flat{{.ratio3 = 0.1}};
    CHECK(length(flat(Vec3{3, 4, 0})) == Approx(5));
    CHECK(length(flat(Vec3{0, 0, 1})) == Approx(10));
    // The first axis to the east, dipping 30°: along it distances stay.
    const Metric turned{{.azimuth_deg = 90, .dip_deg = 30, .ratio2 = 0.5, .ratio3 = 0.2}};
    CHECK(length(turned(Vec3{std::sqrt(3) / 2, 0, -0.5})) == Approx(1));
    CHECK(length(turned(Vec3{0, 1, 0})) == Approx(2));
    CHECK(length(turned(Vec3{0.5, 0, std::sqrt(3) / 2})) == Approx(5));
    // A roll of 90° exchanges the second and third axes.
    const Metric rolled{{.azimuth_deg = 90, .dip_deg = 30, .roll_deg = 90, .ratio2 = 0.5, .ratio3 = 0.2}};
    CHECK(length(rolled(Vec3{0, 1, 0})) == Approx(5));
    CHECK(length(rolled(Vec3{0.5, 0, std::sqrt(3) / 2})) == Approx(2));
}
