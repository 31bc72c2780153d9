// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Cells between four seeds, counted in a tessellation straight from CGAL.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tess/barrier/seeds/ball_radii.hpp"
#include "tess/barrier/seeds/slivers.hpp"
#include "tess/mesh/quality.hpp"
#include "tests/tess/fault_cases.hpp"
#include "tests/tess/scec.hpp"

namespace terratet {
namespace {

using testing::gridded;
using testing::rectangle;

const Box3 extent{{0, 0, 0}, {400, 400, 400}};
constexpr double spacing = 20;

struct Count {
    std::size_t cells = 0;
    std::size_t slivers = 0;   ///< with a dihedral angle below a degree,
    std::size_t enclosed = 0;  ///< and with a ball that nothing may enter
};

/// Of the cells between four seeds in the extent that fill no gap and whose balls may stay empty.
Count count_slivers(const std::vector<Barrier>& faults, const Box3& within) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Base = CGAL::Triangulation_vertex_base_with_info_3<std::size_t, Kernel>;
    using Delaunay = CGAL::Delaunay_triangulation_3<
        Kernel, CGAL::Triangulation_data_structure_3<Base, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
    std::vector<std::pair<std::size_t, Seed>> seeds;
    std::vector<std::pair<Kernel::Point_3, std::size_t>> points;
    for (std::size_t f = 0; f < faults.size(); ++f) {
        for (const Seed& seed : faults[f].seeds) {
            points.push_back({{seed.position.x, seed.position.y, seed.position.z}, seeds.size()});
            seeds.emplace_back(f, seed);
        }
    }
    const BarrierQuery proximity(faults);
    const auto fills_gap = [&](const std::array<std::size_t, 4>& v, const CellPoints& p) {
        const auto differs = [&](std::size_t i) { return seeds[i].second.side != seeds[v[0]].second.side; };
        if (std::ranges::all_of(v, [&](std::size_t i) { return seeds[i].first == seeds[v[0]].first; }) &&
            std::ranges::any_of(v, differs)) {
            return true;
        }
        for (std::size_t f = 0; f < faults.size(); ++f) {
            for (const auto& [i, j] : {std::pair{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}) {
                if (proximity.crosses(static_cast<std::int32_t>(f), p[i], p[j])) {
                    return true;
                }
            }
        }
        return false;
    };
    Count count;
    const Delaunay tessellation(points.begin(), points.end());
    for (const auto cell : tessellation.finite_cell_handles()) {
        std::array<std::size_t, 4> v{};
        CellPoints p;
        for (std::size_t i = 0; i < 4; ++i) {
            v[i] = cell->vertex(static_cast<int>(i))->info();
            p[i] = seeds[v[i]].second.position;
        }
        const CellQuality quality = cell_quality(p);
        if (quality.circumradius <= 3 * faults[0].spacing && within.contains(0.25 * (p[0] + p[1] + p[2] + p[3])) &&
            !fills_gap(v, p)) {
            ++count.cells;
            if (quality.dihedral_min_deg < 1) {
                ++count.slivers;
                count.enclosed += quality.circumradius < faults[0].protection_radius ? 1 : 0;
            }
        }
    }
    return count;
}

Count count_of(const std::vector<Surface>& surfaces, SeedMode mode) {
    BarrierOptions options;
    options.mode = mode;
    return count_slivers(prepare_barriers(surfaces, extent, {}, spacing, options).barriers, extent);
}

Surface dome(double height) {
    return gridded("dome", 40, 40, [=](double u, double v) {
        return Vec3{600 * u - 100, 600 * v - 100, 200 + height * std::sin(3 * u) * std::cos(2 * v)};
    });
}

std::vector<Surface> crossing() {
    return {rectangle("a", {200, 200, 200}, {300, 0, 0}, {0, 300, 0}),
            rectangle("b", {200, 200, 200}, {0, 300, 0}, {100, 0, 290})};
}

}  // namespace

TEST_CASE("In exact mode the seeds round a point make no slivers, flat, all but flat, or bent") {
    for (const double height : {0.0, 1e-5, 1e-2, 1.0, 10.0, 60.0}) {
        INFO("dome of " << height << " m");
        const Count count = count_of({dome(height)}, SeedMode::exact);
        CHECK(count.cells > 0);
        CHECK(count.slivers <= 12);
        CHECK(count.enclosed == 0);
    }
    CHECK(count_of({testing::dipping("dipping", {200, 200, 200}, 37, 52, 500, 500)}, SeedMode::exact).enclosed == 0);
}

TEST_CASE("In exact mode where faults cross, at most one cell in a thousand between seeds is a sliver") {
    Count all;
    for (const double angle : {0.0, 7.0, 21.0, 33.0}) {
        std::vector<Surface> surfaces = crossing();
        surfaces.push_back(testing::dipping("third", {200, 200, 200}, 40 + angle, 70, 500, 500));
        const Count count = count_of(surfaces, SeedMode::exact);
        all.cells += count.cells;
        all.slivers += count.slivers;
    }
    CHECK(all.cells > 10'000);
    CHECK(all.slivers * 1000 <= all.cells);
}

TEST_CASE("Between the seeds of two real faults that cross there is no sliver, in either mode") {
    std::vector<Surface> surfaces;
    for (Surface& surface : testing::scec_surfaces()) {
        if (surface.name.find("SCLV-Del_Valle") != std::string::npos ||
            surface.name.find("SCLV-Holser") != std::string::npos) {
            surfaces.push_back(std::move(surface));
        }
    }
    if (surfaces.empty()) {
        WARN("SKIPPED: public data scec_cfm is absent");
        return;
    }
    const Box3 within = testing::box_of(surfaces);
    for (const SeedMode mode : {SeedMode::exact, SeedMode::paired}) {
        BarrierOptions options;
        options.mode = mode;
        const Count count = count_slivers(prepare_barriers(surfaces, within, {}, 400, options).barriers, within);
        CHECK(count.cells > 9000);
        CHECK(count.slivers == 0);
    }
}

TEST_CASE("Balls of certified corners grow without a seed in them, and as a last resort one pair is lifted out") {
    SheetComplex complex;
    complex.points = {{0, 0, 0}, {10, 0, 0}, {5, 8.6, 0}, {15, 8.6, 0}};
    complex.triangles = {{0, 1, 2}, {1, 3, 2}};
    complex.sheet = {0, 0};
    std::vector<double> radii{5.9, 6.3, 6.3, 7};
    std::vector<BallPair> pairs;
    std::vector<MovablePair> now;
    std::vector<Vec3> places;
    for (const Triangle& v : complex.triangles) {
        pairs.push_back(radical_pair({complex.points[v[0]], complex.points[v[1]], complex.points[v[2]]},
                                     {radii[v[0]], radii[v[1]], radii[v[2]]}));
        const Vec3 up{0, 0, pairs.back().height};
        now.push_back({pairs.back().foot + up, pairs.back().foot - up, 0, 0, 0});
        places.insert(places.end(), {now.back().plus, now.back().minus});
        for (const std::uint32_t corner : v) {
            CHECK(distance(places.back(), complex.points[corner]) == Approx(radii[corner]).epsilon(1e-12));
        }
    }
    const std::vector<std::size_t> numbers{0, 1};
    const std::vector<char> certified(4, 1);
    std::vector<char> placed(2, 1);
    const SeedGrid points(complex.points, 12);
    BallRadii balls({complex,
                     points,
                     {},
                     radii,
                     pairs,
                     numbers,
                     certified,
                     placed,
                     [](std::uint32_t, const Vec3&) { return true; }},
                    places);
    const auto clear = [&](double tolerance) {
        return std::ranges::all_of(now, [&](const MovablePair& pair) {
            for (std::size_t v = 0; v < radii.size(); ++v) {
                if (std::min(distance(pair.plus, complex.points[v]), distance(pair.minus, complex.points[v])) <
                    radii[v] * (1 - tolerance)) {
                    return false;
                }
            }
            return true;
        });
    };
    std::size_t accepted = 0;
    for (std::uint64_t number = 0; number < 40; ++number) {
        for (const PairMove& move : balls.propose(number % 2, number, now)) {
            now[move.pair].plus = move.plus;
            now[move.pair].minus = move.minus;
            accepted += move.pair == number % 2 ? 1 : 0;
        }
        balls.accept();
        CHECK(clear(ball_tolerance));
        CHECK(std::ranges::max(radii) <= 7);  // so the protection radius stays
    }
    CHECK(accepted > 5);
    CHECK(placed == std::vector<char>{1, 1});
    for (std::uint64_t number = last_resort_from; number < last_resort_from + 40 && placed[0] != 0; ++number) {
        const std::vector<PairMove> moves = balls.propose(0, number, now);
        if (moves.size() == 1) {
            now[0].plus = moves[0].plus;
            now[0].minus = moves[0].minus;
            balls.accept();
        }
    }
    CHECK(placed == std::vector<char>{0, 1});
    CHECK(clear(ball_tolerance));
    for (const std::uint32_t corner : complex.triangles[0]) {
        CHECK(distance(now[0].plus, complex.points[corner]) > radii[corner]);
        CHECK(distance(now[0].minus, complex.points[corner]) > radii[corner]);
    }
}

TEST_CASE("In paired mode seeds make no slivers, where faults cross and bend neither") {
    std::size_t cells = 0;
    for (const std::vector<Surface>& surfaces :
         {std::vector{dome(60)}, std::vector{testing::wavy()}, std::vector{testing::cylinder(160)}, crossing()}) {
        INFO(surfaces[0].name);
        const Count count = count_of(surfaces, SeedMode::paired);
        CHECK(count.slivers == 0);
        cells += count.cells;
    }
    CHECK(cells > 100);
}

}  // namespace terratet
