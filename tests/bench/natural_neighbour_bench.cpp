// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Sibson weights per second, CGAL's sibson_natural_neighbor_coordinates_3 against NaturalNeighbour on the same sites
/// and queries in the same run. CGAL gets the queries in Morton order one by one, each located from the cell of the one
/// before: its best case. NaturalNeighbour gets them in blocks of 4096, as model sources ask; all at once in random
/// order, which it sorts itself; and singly in random order, as refinement asks.
///
///   natural_neighbour_bench [QUERIES=100000]
///   natural_neighbour_bench --threads              what a second thread gains
///   natural_neighbour_bench --regular [SITES=10000]     samples on lattices, planes, lines, layers and spheres against
///                                                  the same number jittered
///   natural_neighbour_bench --builds               places all over the extent of a build, many beyond the hull
///   natural_neighbour_bench --sites FILE SITES     what natural_neighbour_peer.py compares with SciPy: FILE holds
///                                                  x, y, z as doubles, SITES sites, then the queries; prints rates
///                                                  of natural, laplace, linear and natural:smooth

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/natural_neighbor_coordinates_3.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "interp/estimator/estimator.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/plan/make_estimator.hpp"
#include "interp/base/morton.hpp"
#include "interp/natural/natural_neighbour.hpp"
#include "regular_sites.hpp"
#include "tess/value_source.hpp"
#include "timing.hpp"

using namespace terratet;
using namespace terratet::bench;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

constexpr int repeats = 5;
constexpr std::size_t block = 4096;

std::vector<Vec3> random_places(std::size_t count) {
    testing::Random random(3);
    std::vector<Vec3> places(count);
    for (auto& p : places) {
        p = random.in({{50, 50, 50}, {950, 950, 950}});
    }
    return places;
}

std::vector<Vec3> morton_sorted(const std::vector<Vec3>& places) {
    std::vector<Vec3> sorted;
    for (const std::uint32_t i : morton_order(places)) {
        sorted.push_back(places[i]);
    }
    return sorted;
}

/// Over stretches of 50 places spread evenly over all, since zones differ much from place to place.
double cgal_rate(const std::vector<Vec3>& sites, const std::vector<Vec3>& places, std::size_t count) {
    std::vector<Kernel::Point_3> points;
    for (const auto& p : sites) {
        points.emplace_back(p.x, p.y, p.z);
    }
    const Delaunay delaunay(points.begin(), points.end());
    constexpr std::size_t stretch = 50;
    std::vector<Vec3> spread;
    const std::size_t stretches = count / stretch;
    for (std::size_t i = 0; i < stretches; ++i) {
        const auto begin = places.begin() + static_cast<std::ptrdiff_t>(i * (places.size() - stretch) / stretches);
        spread.insert(spread.end(), begin, begin + stretch);
    }
    std::vector<std::pair<Delaunay::Vertex_handle, double>> coordinates;
    const double seconds = median_seconds(repeats, cpu_s, [&] {
        Delaunay::Cell_handle cell;
        for (const Vec3& q : spread) {
            const Kernel::Point_3 point(q.x, q.y, q.z);
            cell = delaunay.locate(point, cell);
            coordinates.clear();
            double norm = 0;
            CGAL::sibson_natural_neighbor_coordinates_3(delaunay, point, std::back_inserter(coordinates), norm, cell);
        }
    });
    return static_cast<double>(spread.size()) / seconds;
}

struct Own {
    double rate = 0;
    double neighbours = 0;
    std::size_t fallbacks = 0;
};

Own own_rate(const Estimator& estimator, const std::vector<Vec3>& places, std::size_t batch, double (*clock)()) {
    Own own;
    std::vector<ValueQuery> queries;
    for (const Vec3& p : places) {
        queries.push_back({p});
    }
    std::vector<Weights> weights(batch);
    const double seconds = median_seconds(repeats, clock, [&] {
        own.neighbours = 0;
        own.fallbacks = 0;
        for (std::size_t begin = 0; begin < queries.size(); begin += batch) {
            const std::size_t n = std::min(batch, queries.size() - begin);
            estimator.weights(std::span(queries).subspan(begin, n), std::span(weights).first(n));
            for (std::size_t i = 0; i < n; ++i) {
                own.neighbours += static_cast<double>(weights[i].terms.size());
                own.fallbacks += weights[i].fallback;
            }
        }
    });
    own.rate = static_cast<double>(queries.size()) / seconds;
    own.neighbours /= static_cast<double>(queries.size());
    return own;
}

void compare(const char* name, const std::vector<Vec3>& sites, const std::vector<Vec3>& places,
             std::size_t cgal_count) {
    const double start = cpu_s();
    const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
    const NaturalNeighbour estimator(sites, nullptr);
    const double build_s = cpu_s() - start;

    const auto sorted = morton_sorted(places);
    const double cgal = cgal_count > 0 ? cgal_rate(sites, sorted, std::min(cgal_count, places.size())) : 0;
    const Own one = own_rate(estimator, sorted, block, cpu_s);
    const Own unsorted = own_rate(estimator, places, places.size(), cpu_s);
    const Own single = own_rate(estimator, places, 1, cpu_s);
    std::printf("| %s | %.2f | %.0f | %.1f | ", name, build_s,
                static_cast<double>(estimator.memory_bytes()) / static_cast<double>(sites.size()), one.neighbours);
    if (cgal > 0) {
        std::printf("%.2f k | %.1f k | **%.1f**", cgal / 1000, one.rate / 1000, one.rate / cgal);
    } else {
        std::printf(" | %.1f k | ", one.rate / 1000);
    }
    std::printf(" | %.2f | %.1f k | %zu of %zu |\n", unsorted.rate / one.rate, single.rate / 1000, one.fallbacks,
                places.size());
    std::fflush(stdout);
}

/// The gain of a second thread by the clock: best of many short runs in turns, since other programs on the machine take
/// the second core more often than the first. And the processor's time of both, since threads that hinder each other
/// take more of it together.
void threads(const std::vector<Vec3>& sites, const std::vector<Vec3>& places) {
    const NaturalNeighbour estimator(sites, nullptr);
    std::vector<ValueQuery> queries;
    for (const Vec3& p : morton_sorted(places)) {
        queries.push_back({p});
    }
    std::vector<Weights> weights(queries.size());
    constexpr int runs = 40;
    double wall[2] = {1e9, 1e9}, cpu[2] = {1e9, 1e9};
    for (int i = 0; i < 2 * runs; ++i) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1 + i % 2);
        const double start = wall_s(), cpu_start = process_cpu_s();
        estimator.weights(queries, weights);
        wall[i % 2] = std::min(wall[i % 2], wall_s() - start);
        cpu[i % 2] = std::min(cpu[i % 2], process_cpu_s() - cpu_start);
    }
    const auto count = static_cast<double>(queries.size());
    std::printf(
        "%zu uniform sites, best of %d: one thread %.1f k queries/s by the clock, two %.1f k, %.2f times; two threads "
        "take %.2f times the processor's time of one\n",
        sites.size(), runs, count / wall[0] / 1000, count / wall[1] / 1000, wall[0] / wall[1], cpu[1] / cpu[0]);
}

void regular(std::size_t count) {
    const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
    std::printf(
        "| samples | number | build, s | jittered | ratio | µs a place | jittered | ratio | fallbacks |\n"
        "|---|---|---|---|---|---|---|---|---|\n");
    for (const auto& shape : testing::regular_sites(count)) {
        double build[2], place[2];
        std::size_t fallbacks = 0;
        constexpr std::size_t place_count = 1500;
        for (const int jittered : {0, 1}) {
            const auto sites = jittered ? testing::jittered(shape.sites) : shape.sites;
            const double start = cpu_s();
            const NaturalNeighbour estimator(sites, nullptr);
            build[jittered] = cpu_s() - start;
            const auto places = morton_sorted(testing::places_around(shape.sites, place_count));
            const Own own = own_rate(estimator, places, block, cpu_s);
            place[jittered] = 1e6 / own.rate;
            fallbacks = jittered ? fallbacks : own.fallbacks;
        }
        std::printf("| %s | %zu | %.2f | %.2f | %.2f | %.1f | %.1f | **%.2f** | %zu of %zu |\n", shape.name.c_str(),
                    shape.sites.size(), build[0], build[1], build[0] / build[1], place[0], place[1],
                    place[0] / place[1], fallbacks, place_count);
        std::fflush(stdout);
    }
}

struct Shape {
    const char* name;
    std::vector<Vec3> sites;
};

/// Nearly vertical wells on a square grid.
std::vector<Vec3> wells_on_grid(int side, double apart) {
    testing::Random random(1);
    std::vector<Vec3> sites;
    for (int w = 0; w < side * side; ++w) {
        const Vec3 collar{apart * (w % side), apart * (w / side), 1000};
        const Vec3 lean{random(-0.03, 0.03), random(-0.03, 0.03), -1};
        for (int i = 0; i < 250; ++i) {
            sites.push_back(collar + (4 * i + 2) * lean + random.in({{-0.1, -0.1, -0.5}, {0.1, 0.1, 0.5}}));
        }
    }
    return sites;
}

/// As a build values its vertices: all over the box, padded by a twenty-fifth of the diagonal as by default.
void builds() {
    const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
    std::printf("| samples | build, s | neighbours of a place | places/s | fallbacks |\n|---|---|---|---|---|\n");
    const std::vector<Shape> sites = {{"400 wells x 250", testing::borehole_sites(400, 250)},
                                      {"100 wells x 250, 200 apart", wells_on_grid(10, 200)}};
    for (const Shape& shape : sites) {
        const Box3 box = bounding_box(shape.sites);
        testing::Random random(7);
        std::vector<Vec3> places(20'000);
        for (auto& p : places) {
            p = random.in(box.grown(0.04 * box.diagonal()));
        }
        const double start = cpu_s();
        const NaturalNeighbour estimator(shape.sites, nullptr);
        const double build = cpu_s() - start;
        const Own own = own_rate(estimator, morton_sorted(places), block, cpu_s);
        std::printf("| %s | %.2f | %.0f | %.0f | %zu of %zu |\n", shape.name, build, own.neighbours, own.rate,
                    own.fallbacks, places.size());
        std::fflush(stdout);
    }
}

/// For the peer: rates of the family on given sites and queries, one thread.
void rates_on(const std::string& path, std::size_t site_count) {
    std::ifstream file(path, std::ios::binary);
    std::vector<Vec3> sites, places;
    for (Vec3 p; file.read(reinterpret_cast<char*>(&p), sizeof p);) {
        (sites.size() < site_count ? sites : places).push_back(p);
    }
    const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
    for (const char* spec : {"natural", "laplace", "linear", "natural:smooth"}) {
        const auto estimator = make_estimator(parse_estimator(spec), sites, nullptr);
        std::printf("%s %.0f\n", spec, own_rate(*estimator, places, block, cpu_s).rate);
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 4 && std::string(argv[1]) == "--sites") {
        rates_on(argv[2], std::strtoull(argv[3], nullptr, 10));
        return 0;
    }
    if (argc == 2 && std::string(argv[1]) == "--threads") {
        threads(testing::uniform_sites(100'000), random_places(100'000));
        return 0;
    }
    if (argc >= 2 && std::string(argv[1]) == "--regular") {
        regular(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 10'000);
        return 0;
    }
    if (argc == 2 && std::string(argv[1]) == "--builds") {
        builds();
        return 0;
    }
    const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100'000;
    const auto places = random_places(count);
    std::printf("%zu queries, one thread, medians of %d runs by its CPU time\n\n", count, repeats);
    std::printf(
        "| sites | build, s | bytes/site | neighbours | CGAL, queries/s | ours | ratio | unsorted / sorted | one by "
        "one, "
        "random order | fallbacks |\n|---|---|---|---|---|---|---|---|---|---|\n");
    compare("1,000 uniform", testing::uniform_sites(1'000), places, 20'000);
    compare("10,000 uniform", testing::uniform_sites(10'000), places, 20'000);
    compare("100,000 uniform", testing::uniform_sites(100'000), places, 20'000);
    compare("1,000,000 uniform", testing::uniform_sites(1'000'000), places, 20'000);
    compare("400 wells x 250", testing::borehole_sites(400, 250), places, 2'000);
    const std::vector<Vec3> few(places.begin(), places.begin() + static_cast<std::ptrdiff_t>(count / 50));
    compare("4 wells x 323", testing::borehole_sites(4, 323), few, 0);
}
