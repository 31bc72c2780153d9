// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// From samples in any order to a tessellation with records and values (canonical order, merging, vertices, Delaunay),
/// against CGAL's bare insert(range) of the same points in the same run. Peak memory of each in a process of its own.
///
///   build_bench [SAMPLES=1000000]

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cstdio>
#include <cstdlib>

#include "memory.hpp"
#include "sites.hpp"
#include "tess/property.hpp"
#include "tess/samples.hpp"
#include "tess/tessellation.hpp"
#include "timing.hpp"

using namespace terratet;
using namespace terratet::bench;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

constexpr int repeats = 3;

/// Loose samples with one property, one in a thousand twice.
Samples samples_at(const std::vector<Vec3>& sites) {
    Samples samples;
    samples.positions = sites;
    for (std::size_t i = 0; i < sites.size(); i += 1000) {
        samples.positions.push_back(sites[i]);
    }
    const std::size_t n = samples.positions.size();
    samples.borehole.assign(n, -1);
    samples.depth.assign(n, missing);
    samples.length.assign(n, 0);
    samples.values.emplace_back();
    for (const Vec3& p : samples.positions) {
        samples.values[0].push_back(p.x + p.z);
    }
    return samples;
}

void build(const Samples& raw) {
    const std::vector<Property> properties = {{"f", "", Scale::linear, Kind::continuous, {}}};
    Samples samples = selected(raw, canonical_order(raw));
    merge_coincident(samples, properties);
    std::vector<Vertex> vertices(samples.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        vertices[i] = {i, samples.positions[i], Role::sample, static_cast<std::int32_t>(i), 0};
    }
    Tessellation tessellation;
    tessellation.insert(vertices);
    if (tessellation.cell_count() < samples.size()) {
        std::abort();
    }
}

void insert_plainly(const std::vector<Kernel::Point_3>& points) {
    const Delaunay delaunay(points.begin(), points.end());
    if (delaunay.number_of_finite_cells() < points.size()) {
        std::abort();
    }
}

void compare(const char* name, const std::vector<Vec3>& sites) {
    const Samples samples = samples_at(sites);
    std::vector<Kernel::Point_3> points;
    for (const Vec3& p : sites) {
        points.emplace_back(p.x, p.y, p.z);
    }
    const auto count = static_cast<double>(sites.size());
    const double cgal_bytes = static_cast<double>(peak_memory_of([&] { insert_plainly(points); })) / count;
    const double own_bytes = static_cast<double>(peak_memory_of([&] { build(samples); })) / count;
    const double cgal = count / median_seconds(repeats, cpu_s, [&] { insert_plainly(points); });
    const double own = count / median_seconds(repeats, cpu_s, [&] { build(samples); });
    std::printf("| %s | %.0f k | %.0f k | %.2f | %.0f | %.0f |\n", name, cgal / 1000, own / 1000, own / cgal,
                cgal_bytes, own_bytes);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
    std::printf(
        "%zu samples in random order, median of %d runs by the thread's CPU time; memory: peak of a fresh process "
        "beyond its input\n\n",
        count, repeats);
    std::printf(
        "| samples | CGAL insert, points/s | whole build, points/s | ratio | CGAL, bytes/point | whole build, "
        "bytes/point |\n|---|---|---|---|---|---|\n");
    compare("uniform", testing::shuffled(testing::uniform_sites(count), 2));
    compare("400 wells", testing::shuffled(testing::borehole_sites(400, count / 400), 2));
}
