// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Out of core: vertices that are never all in memory, by tiles with halos (tess/mesh/tile.hpp) to voxels.
///     scale_bench VERTICES VOXELS [TILE=128] [whole]
/// VERTICES at random in a cube, made block by block when they are asked for; VOXELS along an axis, a multiple of 64;
/// TILE voxels along a tile. `whole` tessellates all at once instead: the digest of the voxels must be the same.

#include <sys/resource.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#include "interp/voxels/cell_scan.hpp"
#include "tess/mesh/tile.hpp"
#include "tess/tessellation.hpp"
#include "timing.hpp"

using namespace terratet;

namespace {

constexpr double side = 1000;
const Box3 hull{{0, 0, 0}, {side, side, side}};
constexpr std::uint64_t a_block = 2000;  ///< vertices, about

struct Blocks {
    int along;
    std::uint64_t each;
    int faces;  ///< steps of the grid on them

    explicit Blocks(std::uint64_t vertices)
        : along(std::max(1, static_cast<int>(std::cbrt(static_cast<double>(vertices) / a_block)))),
          each(vertices / static_cast<std::uint64_t>(along * along * along)),
          faces(std::max(1, static_cast<int>(std::cbrt(static_cast<double>(vertices))))) {}

    [[nodiscard]] std::vector<Vertex> in(const Box3& box) const {
        std::vector<Vertex> out;
        const double size = side / along;
        const auto first = [&](double x) { return std::clamp(static_cast<int>(x / size), 0, along - 1); };
        for (int i = first(box.lo.x); i <= first(box.hi.x); ++i) {
            for (int j = first(box.lo.y); j <= first(box.hi.y); ++j) {
                for (int k = first(box.lo.z); k <= first(box.hi.z); ++k) {
                    const auto number = static_cast<std::uint64_t>((i * along + j) * along + k);
                    std::mt19937_64 random(number);
                    const auto draw = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
                    for (std::uint64_t v = 0; v < each; ++v) {
                        const double x = draw();
                        const double y = draw();
                        const double z = draw();
                        add({number * each + v, {(i + x) * size, (j + y) * size, (k + z) * size}}, box, out);
                    }
                }
            }
        }
        add_faces(box, out);
        return out;
    }

  private:
    /// A grid on the hull's faces as dense as the vertices within, as models have it.
    void add_faces(const Box3& box, std::vector<Vertex>& out) const {
        const double size = side / faces;
        std::array<int, 3> lo{};
        std::array<int, 3> hi{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lo[axis] = std::max(0, static_cast<int>(std::floor(box.lo[static_cast<int>(axis)] / size)));
            hi[axis] = std::min(faces, static_cast<int>(std::ceil(box.hi[static_cast<int>(axis)] / size)));
        }
        const auto at = [&](int n) { return n == faces ? side : n * size; };
        const std::uint64_t first = each * static_cast<std::uint64_t>(along) * static_cast<std::uint64_t>(along) *
                                    static_cast<std::uint64_t>(along);
        const auto row = static_cast<std::uint64_t>(faces) + 1;
        for (int i = lo[0]; i <= hi[0]; ++i) {
            for (int j = lo[1]; j <= hi[1]; ++j) {
                for (int k = lo[2]; k <= hi[2]; ++k) {
                    if (i % faces == 0 || j % faces == 0 || k % faces == 0) {
                        const auto number =
                            (static_cast<std::uint64_t>(i) * row + static_cast<std::uint64_t>(j)) * row +
                            static_cast<std::uint64_t>(k);
                        add({first + number, {at(i), at(j), at(k)}}, box, out);
                    }
                }
            }
        }
    }

    static void add(const Vertex& vertex, const Box3& box, std::vector<Vertex>& out) {
        if (box.contains(vertex.position)) {
            out.push_back(vertex);
        }
    }
};

std::uint64_t mixed(std::uint64_t digest, std::uint64_t bits) {
    return (digest ^ bits) * 0x100000001b3ULL;
}

/// Digests of the bricks in a range of the lattice, by number.
void scan(const TetMesh& mesh, const Lattice& lattice, const std::array<std::int64_t, 3>& lo, std::int64_t size,
          std::vector<std::uint64_t>& digests) {
    std::vector<double> values;
    for (const Vec3& p : mesh.points) {
        values.push_back(std::sin(p.x / 50) + p.y / side + std::cos(p.z / 80));
    }
    const CellScan scan(mesh, {}, {ScanField{.vertex_values = values}}, lattice);
    Brick brick;
    for (std::size_t n = 0; n < digests.size(); ++n) {
        place_brick(lattice, n, brick);
        bool within = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            within &= brick.lo[axis] >= lo[axis] && brick.lo[axis] < lo[axis] + size;
        }
        if (within) {
            scan.fill(brick);
            std::uint64_t digest = 0xcbf29ce484222325ULL;
            for (const float value : brick.values[0]) {
                std::uint32_t bits = 0;
                std::memcpy(&bits, &value, sizeof bits);
                digest = mixed(digest, bits);
            }
            digests[n] = digest;
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) {
        std::puts("scale_bench VERTICES VOXELS [TILE=128] [whole]");
        return 2;
    }
    const auto wanted = static_cast<std::uint64_t>(std::atof(argv[1]));
    const std::int64_t along = std::atoll(argv[2]);
    const std::int64_t tile_size = argc > 3 ? std::atoll(argv[3]) : 128;
    const bool whole = argc > 4;
    const Blocks blocks(wanted);
    const double voxel = side / static_cast<double>(along);
    const Lattice lattice{{voxel / 2, voxel / 2, voxel / 2}, {voxel, voxel, voxel}, {along, along, along}};
    const auto counts = brick_counts(lattice);
    std::vector<std::uint64_t> digests(static_cast<std::size_t>(counts[0] * counts[1] * counts[2]));
    const double begin = bench::wall_s();
    std::atomic<std::uint64_t> read = 0;
    std::atomic<int> grown = 0;
    if (whole) {
        Tessellation all;
        all.insert(blocks.in(hull));
        scan(all.mesh(), lattice, {0, 0, 0}, along, digests);
    } else {
        const double spacing = std::cbrt(side * side * side / static_cast<double>(wanted));
        const std::int64_t tiles = (along + tile_size - 1) / tile_size;
        tbb::parallel_for(std::int64_t{0}, tiles * tiles * tiles, [&](std::int64_t n) {
            const std::array<std::int64_t, 3> lo{n / (tiles * tiles) * tile_size, n / tiles % tiles * tile_size,
                                                 n % tiles * tile_size};
            Box3 box;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                box.lo[static_cast<int>(axis)] = static_cast<double>(lo[axis]) * voxel;
                box.hi[static_cast<int>(axis)] = static_cast<double>(std::min(along, lo[axis] + tile_size)) * voxel;
            }
            const Tile tile = tessellate_tile(box, hull, 4 * spacing, [&](const Box3& b) { return blocks.in(b); });
            read += tile.vertices.size();
            grown += tile.grown;
            scan(tile.mesh, lattice, lo, tile_size, digests);
        });
    }
    std::uint64_t digest = 0xcbf29ce484222325ULL;
    for (const std::uint64_t one : digests) {
        digest = mixed(digest, one);
    }
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const double cpu = static_cast<double>(used.ru_utime.tv_sec) + 1e-6 * static_cast<double>(used.ru_utime.tv_usec);
    std::printf(
        "%llu vertices, %lld^3 voxels, tiles of %lld%s: wall %.1f s, cpu %.1f s, %.2f us a vertex, peak %.0f MB, "
        "read %.2f times, grown %d times, digest %016llx\n",
        static_cast<unsigned long long>(wanted), static_cast<long long>(along), static_cast<long long>(tile_size),
        whole ? " (whole)" : "", bench::wall_s() - begin, cpu, 1e6 * cpu / static_cast<double>(wanted),
        static_cast<double>(used.ru_maxrss) / 1024, static_cast<double>(read) / static_cast<double>(wanted),
        grown.load(), static_cast<unsigned long long>(digest));
    return 0;
}
