// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Tessellation to voxels: 150,000 random points, about a million cells, to 256³, with one thread and two.
///
///   resample_bench [VOXELS [FOLDER]]
///
/// With a folder it leaves there the mesh (mesh.vtu) and the voxels (voxels.f32, x slowest), on which resample_peer.py
/// runs VTK's vtkResampleToImage for comparison, of time and of values.

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <vector>

#include "interp/voxels/resample.hpp"
#include "io/export.hpp"
#include "tests/support.hpp"

namespace {

using namespace terratet;

/// Takes the tiles and forgets them, as a writer that keeps up would.
struct Discard final : TileSink {
    void tile(const Tile&) override {}
};

Model random_model(std::size_t points) {
    const Box3 box{{0, 0, 0}, {1000, 1000, 1000}};
    Model model;
    model.domain = {box, box};
    model.properties.push_back(parse_property("f"));
    testing::Random random(1);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{corner & 1 ? 1000.0 : 0.0, corner & 2 ? 1000.0 : 0.0, corner & 4 ? 1000.0 : 0.0};
        model.vertices.push_back({model.vertices.size(), p, Role::domain, -1, 0});
    }
    while (model.vertices.size() < points) {
        model.vertices.push_back({model.vertices.size(), random.in(box), Role::inserted, -1, 0});
    }
    model.vertex_values.values.resize(1);
    for (const Vertex& vertex : model.vertices) {
        const Vec3& p = vertex.position;
        model.vertex_values.values[0].push_back(std::sin(p.x / 150) * std::cos(p.y / 120) + p.z / 500);
        model.vertex_values.extrapolation.push_back(0);
    }
    return model;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Times {
    double wall;
    double cpu;  ///< of all threads: what a busy machine does not change
};

Times median_seconds(const LinearField& field, const Lattice& lattice, std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<double> wall;
    std::vector<double> cpu;
    for (int run = 0; run < 5; ++run) {
        Discard discard;
        const auto start = std::chrono::steady_clock::now();
        const std::clock_t cpu_start = std::clock();
        resample(field, lattice, discard);
        wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        cpu.push_back(static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC);
    }
    return {median(wall), median(cpu)};
}

}  // namespace

int main(int argc, char** argv) {
    const int voxels = argc > 1 ? std::atoi(argv[1]) : 256;
    const Model model = random_model(150'000);
    const Tessellation tessellation = tessellate(model);
    const TetMesh mesh = tessellation.mesh();
    const LinearField field{&mesh, model.vertex_values.values[0]};
    const double size = 1000.0 / voxels;
    const Lattice lattice = lattice_over(model.domain.extent, {size, size, size});
    std::printf("%zu cells to %d^3 voxels\n", mesh.cells.size(), voxels);
    for (const std::size_t threads : {1, 2}) {
        const Times times = median_seconds(field, lattice, threads);
        std::printf("terratet %zu thread%s %.3f s, %.3f s of CPU, %.1f Mvoxels/s\n", threads, threads == 1 ? " " : "s",
                    times.wall, times.cpu, static_cast<double>(lattice.count()) / times.wall / 1e6);
    }
    if (argc > 2) {
        const std::filesystem::path folder = argv[2];
        const auto voxel_values = resample_dense(field, lattice);
        std::ofstream(folder / "voxels.f32", std::ios::binary)
            .write(reinterpret_cast<const char*>(voxel_values.data()),
                   static_cast<std::streamsize>(voxel_values.size() * sizeof(float)));
        ExportOptions options;
        options.overwrite = true;
        write_vtu({model, mesh, describe_cells(model, mesh)}, (folder / "mesh.vtu").string(), options);
    }
}
