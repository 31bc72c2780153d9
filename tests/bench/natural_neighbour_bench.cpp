// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sibson weights per second: CGAL's sibson_natural_neighbor_coordinates_3 (queries in Morton order, each located from
// the cell before: its best case) against NaturalNeighbour, on the same sites and queries in the same run.
//
// Usage: natural_neighbour_bench [QUERIES=100000]
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/natural_neighbor_coordinates_3.h>
#include <tbb/global_control.h>

#include <cstdio>
#include <cstdlib>

#include "bench_sites.hpp"
#include "interp/morton.hpp"
#include "interp/natural_neighbour.hpp"

using namespace terratet;
using namespace terratet::bench;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

constexpr int repeats = 5;
constexpr std::size_t block = 16384;  // weights held at a time, as the library's callers do

std::vector<ValueQuery> random_queries(std::size_t count) {
    testing::Random random(3);
    std::vector<ValueQuery> queries(count);
    for (auto& query : queries) {
        query.position = random.in({{50, 50, 50}, {950, 950, 950}});
    }
    return queries;
}

double cgal_rate(const std::vector<Vec3>& sites, const std::vector<ValueQuery>& queries, std::size_t count) {
    std::vector<Kernel::Point_3> points;
    for (const auto& p : sites) {
        points.emplace_back(p.x, p.y, p.z);
    }
    const Delaunay delaunay(points.begin(), points.end());
    std::vector<Vec3> places;
    for (const auto& query : queries) {
        places.push_back(query.position);
    }
    const auto order = morton_order(places);
    // A contiguous stretch of the order: as local as the whole.
    const std::size_t begin = (order.size() - count) / 2;
    std::vector<std::pair<Delaunay::Vertex_handle, double>> coordinates;
    const double seconds = median_seconds(3, [&] {
        Delaunay::Cell_handle cell;
        for (std::size_t i = begin; i < begin + count; ++i) {
            const Vec3& q = places[order[i]];
            const Kernel::Point_3 point(q.x, q.y, q.z);
            cell = delaunay.locate(point, cell);
            coordinates.clear();
            double norm = 0;
            CGAL::sibson_natural_neighbor_coordinates_3(delaunay, point, std::back_inserter(coordinates), norm, cell);
        }
    });
    return static_cast<double>(count) / seconds;
}

struct Own {
    double rate = 0;
    double neighbours = 0;
    std::size_t fallbacks = 0;
};

Own own_rate(const NaturalNeighbour& estimator, const std::vector<ValueQuery>& queries, std::size_t batch) {
    Own own;
    std::vector<Weights> weights(batch);
    const double seconds = median_seconds(repeats, [&] {
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

void compare(const char* name, const std::vector<Vec3>& sites, const std::vector<ValueQuery>& queries,
             std::size_t cgal_count) {
    const double build_start = now_s();
    const NaturalNeighbour estimator(sites, nullptr);
    const double build_s = now_s() - build_start;

    const double cgal = cgal_rate(sites, queries, std::min(cgal_count, queries.size()));
    Own one, single;
    {
        const tbb::global_control serial(tbb::global_control::max_allowed_parallelism, 1);
        one = own_rate(estimator, queries, block);
        single = own_rate(estimator, queries, 1);
    }
    const Own all = own_rate(estimator, queries, block);
    std::printf("| %-22s | %6.2f | %5.0f | %5.1f | %9.0f | %9.0f | %6.1fx | %9.0f | %9.0f | %zu of %zu |\n", name, build_s,
                static_cast<double>(estimator.memory_bytes()) / static_cast<double>(sites.size()), one.neighbours,
                cgal, one.rate, one.rate / cgal, all.rate, single.rate, one.fallbacks, queries.size());
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 100'000;
    const auto queries = random_queries(count);
    std::printf("%zu random queries; CGAL: median of 3 runs over a Morton-sorted stretch, one thread; own: median of %d\n",
                count, repeats);
    std::printf("| sites                  | build s | B/site | nbrs | CGAL /s | own /s, 1 thread | ratio | own /s, all threads "
                "| own /s, batches of 1, unsorted | fallbacks |\n|---|---|---|---|---|---|---|---|---|---|\n");
    compare("1e5 uniform", uniform_sites(100'000), queries, 20'000);
    compare("400 wells x 250", borehole_sites(400, 250), queries, 1'500);
}
