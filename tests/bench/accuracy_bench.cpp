// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// What adaptivity buys (docs/accuracy.md): errors of the adaptive tessellation's piecewise linear field against a
/// uniform grid with as many values and a uniform tetrahedral mesh with as many vertices, for three analytic fields:
/// with the formula's value at each vertex, and with values that the default estimator makes of the samples.
///
///   accuracy_bench [--insertion-only] [--scale S=1] [--wells N=5] [--places N=1000000] [--section FOLDER]
///
/// There are N by N wells.
///
/// With --section, FOLDER gets what docs/images/accuracy.py makes its picture from.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "tess/error.hpp"
#include "tests/estimated_accuracy.hpp"
#include "timing.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

struct Arguments {
    bool clean_up = true;
    double scale = 1;
    int wells = 5;
    std::size_t places = 1'000'000;
    std::string folder;
};

Arguments parse(int argc, char** argv) {
    Arguments arguments;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--insertion-only") == 0) {
            arguments.clean_up = false;
        } else if (i + 1 < argc && std::strcmp(argv[i], "--scale") == 0) {
            arguments.scale = std::atof(argv[++i]);
        } else if (i + 1 < argc && std::strcmp(argv[i], "--wells") == 0) {
            arguments.wells = std::atoi(argv[++i]);
        } else if (i + 1 < argc && std::strcmp(argv[i], "--places") == 0) {
            arguments.places = std::strtoull(argv[++i], nullptr, 10);
        } else if (i + 1 < argc && std::strcmp(argv[i], "--section") == 0) {
            arguments.folder = argv[++i];
        } else {
            throw UsageError(std::string("accuracy_bench does not know ") + argv[i]);
        }
    }
    return arguments;
}

struct Comparison {
    MeshField own;
    GridField grid;
    MeshField mesh;
};

/// The section y = 500 of each: the truth and three errors as float32 rows of pixels, x fastest, then the own mesh's
/// cells as polygons, one a line, x and z alternating.
void write_section(const std::string& stem, const AnalyticSite& site, const Comparison& all) {
    constexpr int width = 1000;
    constexpr int height = 500;
    std::vector<Vec3> pixels;
    for (int k = 0; k < height; ++k) {
        for (int i = 0; i < width; ++i) {
            pixels.push_back({i + 0.5, 500, k + 0.5});
        }
    }
    std::ofstream raster(stem + ".f32", std::ios::binary);
    const auto write = [&](double value) {
        const auto single = static_cast<float>(value);
        raster.write(reinterpret_cast<const char*>(&single), sizeof single);
    };
    for (const Vec3& p : pixels) {
        write(site.field(p));
    }
    for (const auto& field :
         {errors(all.own, site, pixels), errors(all.grid, site, pixels), errors(all.mesh, site, pixels)}) {
        for (const double error : field) {
            write(error);
        }
    }
    std::ofstream polygons(stem + ".txt");
    for (const auto& polygon : section(all.own.mesh, 1, 500.0)) {
        for (const Vec3& p : polygon) {
            polygons << p.x << ' ' << p.z << ' ';
        }
        polygons << '\n';
    }
    if (!raster.flush() || !polygons.flush()) {
        throw Error("cannot write " + stem + ".f32 and .txt");
    }
}

void print_row(const std::string& name, const AnalyticSite& site, const Comparison& all, std::size_t count,
               double seconds) {
    const auto places = probes(site.options.extent, count);
    const double own = root_mean_square(errors(all.own, site, places));
    const double grid = root_mean_square(errors(all.grid, site, places));
    const double mesh = root_mean_square(errors(all.mesh, site, places));
    std::printf("| %s | %zu | %.5f | %.5f (%zu values) | %.5f (%zu vertices) | %.1f | %.1f | %.1f |\n", name.c_str(),
                all.own.values.size(), own, grid, all.grid.values.size(), mesh, all.mesh.values.size(), grid / own,
                mesh / own, seconds);
    std::fflush(stdout);
}

void compare(const AnalyticSite& site, const std::string& stem, std::size_t count) {
    BuildReport report;
    Comparison all;
    const double start = bench::wall_s();
    all.own = adaptive(site, report);
    const double seconds = bench::wall_s() - start;
    all.grid = uniform_grid(site, all.own.values.size());
    all.mesh = uniform_mesh(site, all.own.values.size());
    print_row(site.name, site, all, count, seconds);
    if (!stem.empty()) {
        write_section(stem, site, all);
    }
}

/// As compare(), with estimated values; and the error of the estimator itself, which no mesh can undercut for long.
void compare_estimated(const AnalyticSite& site, std::size_t count) {
    const double start = bench::wall_s();
    const EstimatedSite built(site);
    const double seconds = bench::wall_s() - start;
    Comparison all;
    all.own = field_of(built.model());
    all.grid = built.estimated(uniform_grid(site, all.own.values.size()));
    all.mesh = built.estimated(uniform_mesh(site, all.own.values.size()));
    print_row(site.name + ", estimated", site, all, count, seconds);
    const auto places = probes(site.options.extent, count / 10);
    std::vector<double> off = built.estimates(places);
    for (std::size_t i = 0; i < places.size(); ++i) {
        off[i] -= site.field(places[i]);
    }
    std::printf("| %s, the estimator at the places | | %.5f | | | | | |\n", site.name.c_str(), root_mean_square(off));
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const Arguments arguments = parse(argc, argv);
    std::printf("rms errors at %zu places, scale %g, %d by %d wells%s\n\n", arguments.places, arguments.scale,
                arguments.wells, arguments.wells, arguments.clean_up ? "" : ", clean-up off");
    std::printf(
        "| field | vertices | adaptive | uniform grid | uniform mesh | grid / adaptive | mesh / adaptive | seconds "
        "|\n|---|---|---|---|---|---|---|---|\n");
    const std::pair<const char*, AnalyticSite (*)(double, int)> sites[] = {
        {"trend", smooth_trend}, {"layer", thin_layer}, {"zone", raised_zone}};
    for (const auto& [stem, make] : sites) {
        AnalyticSite site = make(arguments.scale, arguments.wells);
        site.options.refine.clean_up = arguments.clean_up;
        compare(site, arguments.folder.empty() ? "" : arguments.folder + "/" + stem, arguments.places);
        compare_estimated(site, arguments.places);
    }
}
