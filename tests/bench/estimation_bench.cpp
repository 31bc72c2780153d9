// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Nearest, inverse distance and kriging: rates and memory, and the same questions left in a folder for
/// estimation_peer.py, which asks scipy and gstat.
///     estimation_bench FOLDER [SITES [QUERIES]]

#include <tbb/global_control.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "bench/memory.hpp"
#include "bench/timing.hpp"
#include "interp/estimator/estimator.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/plan/make_estimator.hpp"
#include "sites.hpp"
#include "tess/value_source.hpp"

using namespace terratet;
using namespace terratet::testing;
using namespace terratet::bench;

namespace {

constexpr const char* specs[] = {
    "nearest", "idw:max_points=12",
    "kriging:model=exponential:nugget=0.1:sill=1:range=150:ratio3=1:max_points=24:per_octant=0:per_borehole=0",
    "kriging:model=exponential:nugget=0.1:sill=1:range=150:ratio3=1"};
constexpr const char* names[] = {"nearest", "idw", "kriging", "kriging_octants"};

double field(const Vec3& p) {
    return std::sin(p.x / 150) * std::cos(p.y / 120) + p.z / 500;
}

void save(const std::filesystem::path& path, const std::vector<double>& numbers) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers.data()),
               static_cast<std::streamsize>(numbers.size() * sizeof(double)));
}

std::vector<double> flat(const std::vector<Vec3>& points) {
    std::vector<double> numbers;
    for (const Vec3& p : points) {
        numbers.insert(numbers.end(), {p.x, p.y, p.z});
    }
    return numbers;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: estimation_bench FOLDER [SITES [QUERIES]]\n");
        return 2;
    }
    const std::filesystem::path folder = argv[1];
    const auto sites = uniform_sites(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 100'000, 1);
    const auto places = uniform_sites(argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 100'000, 2);
    std::vector<double> values;
    for (const Vec3& p : sites) {
        values.push_back(field(p));
    }
    save(folder / "sites.f64", flat(sites));
    save(folder / "values.f64", values);
    save(folder / "places.f64", flat(places));
    std::vector<ValueQuery> queries;
    for (const Vec3& p : places) {
        queries.push_back({p, -1, 0});
    }
    std::vector<Weights> weights(queries.size());
    for (std::size_t s = 0; s < std::size(specs); ++s) {
        double build_s = wall_s();
        const auto estimator = make_estimator(parse_estimator(specs[s]), sites, nullptr);
        build_s = wall_s() - build_s;
        double seconds[2];
        for (const std::size_t threads : {1, 2}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            seconds[threads - 1] =
                median_seconds(3, threads == 1 ? cpu_s : wall_s, [&] { estimator->weights(queries, weights); });
        }
        const std::size_t grown = peak_memory_of([&] {
            const auto again = make_estimator(parse_estimator(specs[s]), sites, nullptr);
            std::vector<Weights> block(4096);
            for (std::size_t begin = 0; begin + block.size() <= queries.size(); begin += block.size()) {
                again->weights(std::span(queries).subspan(begin, block.size()), block);
            }
        });
        std::vector<double> results;
        for (const auto& w : weights) {
            double value = 0;
            for (const auto& [site, weight] : w.terms) {
                value += weight * values[site];
            }
            results.push_back(value);
            results.push_back(w.variance);
        }
        save(folder / (std::string(names[s]) + ".f64"), results);
        std::printf("%-16s build %.3f s  1 thread %.4f s  2 threads %.4f s  %.0f bytes a site\n", names[s], build_s,
                    seconds[0], seconds[1], static_cast<double>(grown) / static_cast<double>(sites.size()));
    }
}
