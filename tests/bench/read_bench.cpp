// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Tables to a site: a CSV of loose samples, a CSV of a log with its collars, and a LAS log, each of as many megabytes
/// as wished, from a warm cache with one thread, and how much memory that takes beside the samples kept.
///
///   read_bench [MEGABYTES [FOLDER [samples|log|LAS]]]
///
/// The files stay in the folder (/tmp/read_bench), where read_peer.py has pandas and GDAL read them.

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "io/read_site.hpp"
#include "tests/bench/memory.hpp"
#include "tests/bench/timing.hpp"
#include "tests/support.hpp"

namespace {

using namespace terratet;

constexpr int properties = 6;
constexpr std::size_t rows_a_hole = 500;

std::string values(testing::Random& random) {
    std::string text;
    for (int p = 0; p < properties; ++p) {
        text += fmt::format(",{:.4f}", std::exp(2 * random()));
    }
    return text;
}

std::string names(const char* separator) {
    std::string text;
    for (int p = 0; p < properties; ++p) {
        text += fmt::format("{}P{}", separator, p);
    }
    return text;
}

void write_samples(const std::string& path, double bytes) {
    std::ofstream file(path);
    testing::Random random(1);
    file << "X,Y,Z" << names(",") << "\n";
    for (double written = 0; written < bytes;) {
        const std::string line = fmt::format("{:.2f},{:.2f},{:.2f}{}\n", 500000 + 5000 * random(),
                                             6700000 + 5000 * random(), -800 * random(), values(random));
        file << line;
        written += static_cast<double>(line.size());
    }
}

void write_log(const std::string& path, const std::string& collar_path, double bytes) {
    std::ofstream file(path);
    std::ofstream collars(collar_path);
    testing::Random random(2);
    file << "BHID,FROM,TO" << names(",") << "\n";
    collars << "BHID,X,Y,Z,LENGTH\n";
    std::size_t row = 0;
    for (double written = 0; written < bytes; ++row) {
        const std::string hole = fmt::format("DH-{:05}", row / rows_a_hole);
        const std::size_t k = row % rows_a_hole;
        if (k == 0) {
            collars << fmt::format("{},{:.2f},{:.2f},{:.2f},{}\n", hole, 500000 + 5000 * random(),
                                   6700000 + 5000 * random(), 100 * random(), rows_a_hole);
        }
        const std::string line = fmt::format("{},{:.1f},{:.1f}{}\n", hole, static_cast<double>(k),
                                             static_cast<double>(k + 1), values(random));
        file << line;
        written += static_cast<double>(line.size());
    }
}

void write_las(const std::string& path, double bytes) {
    std::ofstream file(path);
    testing::Random random(3);
    file << "~V\nVERS. 2.0:\nWRAP. NO:\n~W\nNULL. -999.25:\nWELL. W-1:\nX.M 500000:\nY.M 6700000:\nEREF.M 50:\n~C\n"
            "DEPT.M:\n";
    for (int p = 0; p < properties; ++p) {
        file << fmt::format("P{}.:\n", p);
    }
    file << "~A\n";
    double depth = 0;
    for (double written = 0; written < bytes; depth += 0.01) {
        std::string line = fmt::format("{:.3f}", depth) + values(random) + "\n";
        std::replace(line.begin(), line.end(), ',', ' ');
        file << line;
        written += static_cast<double>(line.size());
    }
}

double bytes_of(const Samples& samples) {
    return static_cast<double>(samples.size()) * (24 + 4 + 8 + 8 + 8.0 * static_cast<double>(samples.values.size()));
}

void measure(const char* name, const std::string& path, const SiteInputs& inputs) {
    const auto size = static_cast<double>(std::filesystem::file_size(path));
    double kept = 0;
    std::size_t samples = 0;
    Diagnostics diagnostics;
    const double seconds = bench::median_seconds(1, bench::process_cpu_s, [&] {
        const Site site = read_site(inputs, diagnostics);
        kept = bytes_of(site.samples);
        samples = site.samples.size();
    });
    const auto peak = static_cast<double>(bench::peak_memory_of([&] {
        Diagnostics ignored;
        const Site site = read_site(inputs, ignored);
    }));
    std::printf("%-8s %7.0f MB %9zu samples %7.2f s %6.0f MB/s  kept %5.0f MB, peak %5.0f MB: %.2f times\n", name,
                size / 1e6, samples, seconds, size / 1e6 / seconds, kept / 1e6, peak / 1e6, peak / kept);
    for (const Rejected& rejected : diagnostics.rejected) {
        std::printf("  rejected: %s\n", rejected.reason.c_str());
        break;
    }
}

}  // namespace

int main(int argc, char** argv) {
    const double megabytes = argc > 1 ? std::atof(argv[1]) : 100;
    const std::filesystem::path folder = argc > 2 ? argv[2] : "/tmp/read_bench";
    std::filesystem::create_directories(folder);
    const std::string samples = folder / fmt::format("samples_{:g}.csv", megabytes);
    const std::string log = folder / fmt::format("log_{:g}.csv", megabytes);
    const std::string collar = folder / fmt::format("collar_{:g}.csv", megabytes);
    const std::string las = folder / "log.las";
    if (!std::filesystem::exists(samples)) {
        write_samples(samples, 1e6 * megabytes);
        write_log(log, collar, 1e6 * megabytes);
        write_las(las, 1e8);
    }
    SiteInputs loose;
    loose.source_crs = "EPSG:3067";
    SiteInputs drilled = loose;
    SiteInputs well = loose;
    loose.samples = {{samples}};
    drilled.boreholes = {{collar}};
    drilled.logs = {{log}};
    well.boreholes = {{las}};
    const std::string only = argc > 3 ? argv[3] : "";
    for (const auto& [name, path, inputs] :
         {std::tuple{"samples", samples, loose}, {"log", log, drilled}, {"LAS", las, well}}) {
        if (only.empty() || only == name) {
            measure(name, path, inputs);
        }
    }
}
