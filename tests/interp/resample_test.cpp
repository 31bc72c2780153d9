// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/voxels/resample.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <set>

#include "kuhn_mesh.hpp"
#include "support.hpp"
#include "tess/barrier_query.hpp"
#include "tess/error.hpp"

using namespace terratet;
using terratet::testing::kuhn_mesh;
using terratet::testing::Node;
using terratet::testing::Random;

namespace {

const Box3 unit{{0, 0, 0}, {1, 1, 1}};

/// Barycentric coordinates by Cramer's rule in long double, from the true coordinates: the oracle.
std::array<long double, 4> oracle_weights(const TetMesh& mesh, std::size_t cell, const Vec3& p) {
    using Real = long double;
    struct V {
        Real x, y, z;
    };
    const auto at = [&](std::size_t k) {
        const Vec3& q = mesh.points[mesh.cells[cell][k]];
        return V{Real(q.x) - Real(p.x), Real(q.y) - Real(p.y), Real(q.z) - Real(p.z)};
    };
    const auto det3 = [](const V& a, const V& b, const V& c) {
        return a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
    };
    const V a = at(0), b = at(1), c = at(2), d = at(3);
    const Real w0 = det3(b, c, d), w1 = -det3(a, c, d), w2 = det3(a, b, d), w3 = -det3(a, b, c);
    const Real sum = w0 + w1 + w2 + w3;
    return {w0 / sum, w1 / sum, w2 / sum, w3 / sum};
}

/// The smallest weight of p in the cell: not negative exactly inside.
long double depth_in_cell(const TetMesh& mesh, std::size_t cell, const Vec3& p) {
    const auto w = oracle_weights(mesh, cell, p);
    return std::min(std::min(w[0], w[1]), std::min(w[2], w[3]));
}

TetMesh regular(const Node& boxes, const Box3& box) {
    const Vec3 side = box.size();
    return kuhn_mesh(boxes, [=](const Node& n) {
        return Vec3{box.lo.x + side.x * n[0] / boxes[0], box.lo.y + side.y * n[1] / boxes[1],
                    box.lo.z + side.z * n[2] / boxes[2]};
    });
}

/// Interior nodes moved by up to a share of the spacing; `flatten` squeezes z so that cells become thin.
TetMesh jittered(int boxes, double share, std::uint64_t seed, double flatten = 1) {
    auto random = std::make_shared<Random>(seed);
    return kuhn_mesh({boxes, boxes, boxes}, [=](const Node& n) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            const int i = n[static_cast<std::size_t>(axis)];
            const double move = (*random)(-share, share);
            p[axis] = (i + (i == 0 || i == boxes ? 0 : move)) / boxes;
        }
        p.z *= flatten;
        return p;
    });
}

/// The Delaunay tessellation of a grid's nodes, those inside moved a little. Nearly cospherical points make cells as
/// thin as they are far from it.
TetMesh delaunay_grid(double jitter) {
    Random random(17);
    std::vector<Vertex> vertices;
    for (int i = 0; i <= 8; ++i) {
        for (int j = 0; j <= 8; ++j) {
            for (int k = 0; k <= 8; ++k) {
                Vec3 p;
                for (int axis = 0; axis < 3; ++axis) {
                    const int n = axis == 0 ? i : axis == 1 ? j : k;
                    p[axis] = n / 8.0 + (n == 0 || n == 8 ? 0 : random(-jitter, jitter));
                }
                vertices.push_back({vertices.size(), p, Role::inserted, -1, 0});
            }
        }
    }
    Tessellation tessellation;
    tessellation.insert(vertices);
    return tessellation.mesh();
}

std::vector<double> values_at(const TetMesh& mesh, const std::function<double(const Vec3&)>& f) {
    std::vector<double> values;
    for (const Vec3& p : mesh.points) {
        values.push_back(f(p));
    }
    return values;
}

std::size_t at(const Lattice& lattice, std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<std::size_t>((i * lattice.size[1] + j) * lattice.size[2] + k);
}

template <class Visit>
void for_each_voxel(const Lattice& lattice, Visit&& visit) {
    for (std::int64_t i = 0; i < lattice.size[0]; ++i) {
        for (std::int64_t j = 0; j < lattice.size[1]; ++j) {
            for (std::int64_t k = 0; k < lattice.size[2]; ++k) {
                visit(lattice.center(i, j, k), at(lattice, i, j, k));
            }
        }
    }
}

std::size_t uncovered(const std::vector<float>& values) {
    return static_cast<std::size_t>(std::count_if(values.begin(), values.end(), [](float v) { return std::isnan(v); }));
}

/// A lattice with voxel centres at both ends of the box on every axis: on hull facets, edges and corners.
Lattice node_lattice(const Box3& box, std::int64_t n) {
    return {box.lo, box.size() / static_cast<double>(n), {n + 1, n + 1, n + 1}};
}

}  // namespace

TEST_CASE("A lattice covers its box, centred, without a voxel too many for rounding") {
    const Lattice lattice = lattice_over({{0.1, -5, 1000}, {0.7, 5, 1010}}, {0.1, 4, 10});
    CHECK(lattice.size == std::array<std::int64_t, 3>{6, 3, 1});
    CHECK(lattice.center(0, 0, 0).x == Approx(0.15));
    CHECK(lattice.center(0, 0, 0).y == Approx(-4));
    CHECK(lattice.center(0, 0, 0).z == Approx(1005));
    CHECK(lattice.center(5, 2, 0).x == Approx(0.65));
}

TEST_CASE("A voxel size that is not positive or makes too many voxels is refused with one that fits") {
    CHECK_THROWS_AS(lattice_over(unit, {0, 1, 1}), UsageError);
    CHECK_THROWS_AS(lattice_over(unit, {1, -1, 1}), UsageError);
    CHECK_THROWS_AS(lattice_over(unit, {1, 1, std::nan("")}), UsageError);
    CHECK_THROWS_AS(lattice_over(Box3{}, {1, 1, 1}), UsageError);
    std::string message;
    try {
        lattice_over({{0, 0, 0}, {1000, 1000, 10}}, {0.1, 0.1, 0.1}, 1'000'000);
    } catch (const UsageError& error) {
        message = error.what();
    }
    double x = 0, y = 0, z = 0;
    REQUIRE(std::sscanf(message.c_str() + message.find(';'), "; %lf × %lf × %lf", &x, &y, &z) == 3);
    const Lattice fits = lattice_over({{0, 0, 0}, {1000, 1000, 10}}, {x, y, z}, 1'000'000);
    CHECK(fits.count() <= 1'000'000);
    CHECK(fits.count() > 500'000);
}

TEST_CASE("Every voxel centre inside the union of cells gets a value, whatever the mesh") {
    const auto lattice_size = GENERATE(std::int64_t{17}, std::int64_t{60}, std::int64_t{97});
    SECTION("on lattices aligned to the mesh, where centres lie on facets, edges and vertices") {
        for (const int boxes : {1, 3, 7, 10}) {
            const Box3 box{{-3, 0.1, 1e6}, {4, 0.8, 1e6 + 0.7}};
            const TetMesh mesh = regular({boxes, boxes, boxes}, box);
            const std::vector<double> ones(mesh.points.size(), 1.0);
            CHECK(uncovered(resample_dense({&mesh, ones}, node_lattice(box, lattice_size))) == 0);
        }
    }
    SECTION("on random meshes") {
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const TetMesh mesh = jittered(static_cast<int>(2 + seed), 0.2, seed);
            const std::vector<double> ones(mesh.points.size(), 1.0);
            CHECK(uncovered(resample_dense({&mesh, ones}, node_lattice(unit, lattice_size))) == 0);
        }
    }
    SECTION("on meshes of very flat cells") {
        for (const double flatten : {1e-2, 1e-5, 1e-8}) {
            const Box3 flat{{0, 0, 0}, {1, 1, flatten}};
            const TetMesh mesh = jittered(6, 0.2, 5, flatten);
            const std::vector<double> ones(mesh.points.size(), 1.0);
            // Cubic voxels: the whole mesh is a sheet through the middle of one layer.
            const Lattice lattice{{0, 0, flatten / 2}, {1.0 / 96, 1.0 / 96, 1.0 / 96}, {97, 97, 1}};
            CHECK(uncovered(resample_dense({&mesh, ones}, lattice)) == 0);
            CHECK(uncovered(resample_dense({&mesh, ones}, node_lattice(flat, lattice_size))) == 0);
        }
    }
}

TEST_CASE(
    "Slivers leave no hole and no stray value: a linear field comes back linear from Delaunay cells of any shape") {
    const double jitter = GENERATE(0.0, 1e-13, 1e-11, 1e-9, 1e-7, 1e-5, 1e-2);
    const TetMesh mesh = delaunay_grid(jitter);
    const auto linear = [](const Vec3& p) { return 1 + 2 * p.x - 3 * p.y + 5 * p.z; };
    const auto f = values_at(mesh, linear);
    for (const std::int64_t size : {64, 83}) {
        const Lattice lattice = node_lattice(unit, size);
        const auto values = resample_dense({&mesh, f}, lattice);
        CHECK(uncovered(values) == 0);
        double worst = 0;
        for_each_voxel(lattice, [&](const Vec3& p, std::size_t voxel) {
            worst = std::max(worst, std::abs(static_cast<double>(values[voxel]) - linear(p)));
        });
        INFO(jitter << ' ' << size);
        CHECK(worst < 2e-6);
    }
}

TEST_CASE("No voxel centre outside the cells gets a value") {
    // Cells in a ball only; the oracle asks every cell about every voxel.
    const TetMesh mesh = jittered(7, 0.2, 11);
    std::vector<std::uint8_t> use(mesh.cells.size());
    for (std::size_t c = 0; c < use.size(); ++c) {
        Vec3 center{-0.5, -0.5, -0.5};
        for (const auto v : mesh.cells[c]) {
            center = center + mesh.points[v] / 4;
        }
        use[c] = length(center) < 0.4 ? 1 : 0;
    }
    const std::vector<double> ones(mesh.points.size(), 1.0);
    const Lattice lattice = node_lattice(unit, 28);
    const auto values = resample_dense({&mesh, ones, use}, lattice);
    std::size_t wrong = 0;
    std::size_t covered = 0;
    for_each_voxel(lattice, [&](const Vec3& p, std::size_t index) {
        long double depth = -1;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
            depth = use[c] ? std::max(depth, depth_in_cell(mesh, c, p)) : depth;
        }
        const bool has_value = !std::isnan(values[index]);
        covered += has_value;
        wrong += has_value ? depth < -1e-7L : depth > 1e-12L;  // weights are in units of cell heights, ~2 voxels
    });
    CHECK(covered > 4000);
    CHECK(uncovered(values) > 4000);
    CHECK(wrong == 0);
}

TEST_CASE("A voxel on a common facet, edge or vertex belongs to the cell with the smallest index") {
    // One value a cell: a vertex of its own for each corner.
    const TetMesh shared = regular({4, 4, 4}, {{0, 0, 0}, {4, 4, 4}});
    TetMesh mesh;
    std::vector<double> index;
    for (std::size_t c = 0; c < shared.cells.size(); ++c) {
        std::array<std::uint32_t, 4> cell;
        for (std::size_t k = 0; k < 4; ++k) {
            cell[k] = static_cast<std::uint32_t>(mesh.points.size());
            mesh.points.push_back(shared.points[shared.cells[c][k]]);
            index.push_back(static_cast<double>(c));
        }
        mesh.cells.push_back(cell);
    }
    const Lattice lattice = node_lattice({{0, 0, 0}, {4, 4, 4}}, 32);
    const auto values = resample_dense({&mesh, index}, lattice);
    std::size_t wrong = 0;
    std::size_t contested = 0;
    for_each_voxel(lattice, [&](const Vec3& p, std::size_t voxel) {
        std::size_t owners = 0;
        double owner = -1;
        for (std::size_t c = mesh.cells.size(); c-- > 0;) {
            if (depth_in_cell(mesh, c, p) >= 0) {  // exact here: all coordinates are eighths
                owner = static_cast<double>(c);
                ++owners;
            }
        }
        contested += owners > 1;
        wrong += static_cast<double>(values[voxel]) != owner;
    });
    CHECK(contested > 10000);
    CHECK(wrong == 0);
}

TEST_CASE("A voxel's value is its cell's linear function") {
    const TetMesh mesh = jittered(9, 0.2, 3);
    Random random(4);
    std::vector<double> f(mesh.points.size());
    for (double& value : f) {
        value = random(-5, 5);
    }
    const Lattice lattice = node_lattice(unit, 70);
    const auto values = resample_dense({&mesh, f}, lattice);
    std::size_t checked = 0;
    double worst = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        Box3 box;
        for (const auto v : mesh.cells[c]) {
            box.extend(mesh.points[v]);
        }
        for (int draw = 0; draw < 20; ++draw) {
            const Vec3 q = 70.0 * random.in(box);
            const std::array<std::int64_t, 3> v{std::llround(q.x), std::llround(q.y), std::llround(q.z)};
            const Vec3 p = lattice.center(v[0], v[1], v[2]);
            if (depth_in_cell(mesh, c, p) > 1e-6L) {
                const auto w = oracle_weights(mesh, c, p);
                long double expected = 0;
                for (std::size_t k = 0; k < 4; ++k) {
                    expected += w[k] * static_cast<long double>(f[mesh.cells[c][k]]);
                }
                worst = std::max(worst, std::abs(static_cast<double>(expected) -
                                                 static_cast<double>(values[at(lattice, v[0], v[1], v[2])])));
                ++checked;
            }
        }
    }
    CHECK(checked > 5000);
    CHECK(worst < 5e-6);
}

TEST_CASE("Values never leave the range of the vertices', and a constant stays itself") {
    for (const double jitter : {1e-13, 1e-11, 1e-9, 1e-7, 1e-3}) {
        const TetMesh mesh = delaunay_grid(jitter);
        Random random(9);
        std::vector<double> f(mesh.points.size());
        for (double& value : f) {
            value = random(2, 3);
        }
        const Lattice lattice = node_lattice(unit, 64);
        for (const float value : resample_dense({&mesh, f}, lattice)) {
            REQUIRE(value >= 2.0F);
            REQUIRE(value <= 3.0F);
        }
        const std::vector<double> constant(mesh.points.size(), 0.1);
        for (const float value : resample_dense({&mesh, constant}, lattice)) {
            REQUIRE(value == 0.1F);
        }
    }
}

TEST_CASE("Cells with a missing value, and cells not asked for, leave their voxels without value") {
    const TetMesh mesh = regular({2, 1, 1}, {{0, 0, 0}, {2, 1, 1}});
    auto f = values_at(mesh, [](const Vec3& p) { return p.x; });
    const Lattice lattice{{0.05, 0.05, 0.05}, {0.1, 0.1, 0.1}, {20, 10, 10}};
    CHECK(uncovered(resample_dense({&mesh, f}, lattice)) == 0);
    for (std::size_t v = 0; v < f.size(); ++v) {
        f[v] = mesh.points[v].x == 0 ? std::nan("") : f[v];
    }
    CHECK(uncovered(resample_dense({&mesh, f}, lattice)) == 1000);
    std::vector<std::uint8_t> none(mesh.cells.size(), 0);
    CHECK(uncovered(resample_dense({&mesh, f, none}, lattice)) == 2000);
}

TEST_CASE("Fields in log10 come back in measured units") {
    const TetMesh mesh = regular({1, 1, 1}, {{0, 0, 0}, {4, 1, 1}});
    const auto f = values_at(mesh, [](const Vec3& p) { return p.x - 2; });
    LinearField field{&mesh, f};
    field.log10 = true;
    const Lattice lattice{{0, 0.5, 0.5}, {1, 1, 1}, {5, 1, 1}};
    const auto values = resample_dense(field, lattice);
    for (int i = 0; i < 5; ++i) {
        CHECK(static_cast<double>(values[static_cast<std::size_t>(i)]) == Approx(std::pow(10.0, i - 2)).epsilon(1e-6));
    }
}

TEST_CASE("A category is the class of the largest barycentric weight, never a mixture") {
    const TetMesh mesh = jittered(5, 0.2, 21);
    Random random(22);
    std::vector<double> f(mesh.points.size());
    for (double& value : f) {
        value = static_cast<double>(random.below(4));
    }
    LinearField field{&mesh, f};
    field.categorical = true;
    const Lattice lattice = node_lattice(unit, 40);
    const auto values = resample_dense(field, lattice);
    std::size_t wrong = 0;
    for_each_voxel(lattice, [&](const Vec3& p, std::size_t voxel) {
        bool explained = false;
        for (std::size_t c = 0; c < mesh.cells.size() && !explained; ++c) {
            if (depth_in_cell(mesh, c, p) >= -1e-7L) {
                const auto w = oracle_weights(mesh, c, p);
                const long double most = std::max(std::max(w[0], w[1]), std::max(w[2], w[3]));
                for (std::size_t k = 0; k < 4; ++k) {
                    explained |= w[k] > most - 1e-7L && f[mesh.cells[c][k]] == static_cast<double>(values[voxel]);
                }
            }
        }
        wrong += explained ? 0 : 1;
    });
    CHECK(wrong == 0);
}

TEST_CASE("In a gap cell a voxel takes its own side's value: with 0 and 1 on the sides nothing lies between") {
    // Columns at x = 0, 4.5 | 5.5, 10: the middle layer is the gap, much wider than a voxel.
    const std::array<double, 4> columns{0, 4.5, 5.5, 10};
    const TetMesh mesh = kuhn_mesh({3, 6, 6}, [&](const Node& n) {
        return Vec3{columns[static_cast<std::size_t>(n[0])], n[1] * 10.0 / 6, n[2] * 10.0 / 6};
    });
    std::vector<double> f(mesh.points.size());
    for (std::size_t v = 0; v < f.size(); ++v) {
        f[v] = mesh.points[v].x < 5 ? 0 : 1;
    }
    std::vector<Barrier> faults(1);
    faults[0].sheet.vertices = {{5, -1, -1}, {5, 11, -1}, {5, 11, 11}, {5, -1, 11}};
    faults[0].sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    std::vector<std::int32_t> gap;
    for (const auto& cell : mesh.cells) {
        const auto side = [&](std::uint32_t v) { return mesh.points[v].x < 5; };
        gap.push_back(std::all_of(cell.begin(), cell.end(), side) || std::none_of(cell.begin(), cell.end(), side) ? -1
                                                                                                                  : 0);
    }
    const Box3 box{{0, 0, 0}, {10, 10, 10}};
    const Lattice lattice = node_lattice(box, 80);
    LinearField field{&mesh, f};
    const auto mixed = resample_dense(field, lattice);
    CHECK(std::count_if(mixed.begin(), mixed.end(), [](float v) { return v > 0.1F && v < 0.9F; }) > 10000);

    const BarrierQuery proximity(faults);
    const OwnSide sides(mesh, gap, proximity);
    field.sides = &sides;
    const auto own = resample_dense(field, lattice);
    std::size_t wrong = 0;
    for_each_voxel(lattice, [&](const Vec3& p, std::size_t voxel) {
        wrong += own[voxel] != 0.0F && own[voxel] != 1.0F;
        wrong += p.x < 5 && own[voxel] != 0.0F;
        wrong += p.x > 5 && own[voxel] != 1.0F;
    });
    CHECK(wrong == 0);
    field.categorical = true;
    const auto classes = resample_dense(field, lattice);
    CHECK(std::all_of(classes.begin(), classes.end(), [](float v) { return v == 0.0F || v == 1.0F; }));
}

TEST_CASE("R6: voxels are the same bytes at any number of threads") {
    const TetMesh mesh = jittered(20, 0.2, 31);
    const auto f = values_at(mesh, [](const Vec3& p) { return std::sin(9 * p.x) * std::cos(7 * p.y) + p.z; });
    const Lattice lattice = node_lattice(unit, 150);
    std::vector<std::vector<float>> results;
    for (const std::size_t threads : {1, 2, 7}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        results.push_back(resample_dense({&mesh, f}, lattice));
    }
    for (const auto& result : results) {
        REQUIRE(result.size() == results[0].size());
        CHECK(std::memcmp(result.data(), results[0].data(), result.size() * sizeof(float)) == 0);
    }
}

TEST_CASE("A sink gets each tile that has a value once, aligned, with nothing beyond the lattice") {
    struct Recorder final : TileSink {
        std::mutex mutex;
        std::set<std::array<std::int64_t, 3>> seen;
        std::size_t repeated = 0, beyond = 0, empty = 0;
        void tile(const Tile& tile) override {
            const std::lock_guard lock(mutex);
            repeated += seen.insert(tile.lo).second ? 0 : 1;
            std::size_t values = 0;
            for (int i = 0; i < Tile::edge; ++i) {
                for (int j = 0; j < Tile::edge; ++j) {
                    for (int k = 0; k < Tile::edge; ++k) {
                        const float value =
                            tile.values[static_cast<std::size_t>((i * Tile::edge + j) * Tile::edge + k)];
                        if (!std::isnan(value)) {
                            ++values;
                            beyond += tile.lo[0] + i >= 100 || tile.lo[1] + j >= 70 || tile.lo[2] + k >= 200;
                        }
                    }
                }
            }
            empty += values == 0;
        }
    } recorder;
    // The mesh reaches beyond the lattice on all sides but the last, where it ends early.
    const TetMesh mesh = regular({3, 3, 3}, {{-10, -10, -10}, {150, 150, 100}});
    const std::vector<double> ones(mesh.points.size(), 1.0);
    resample({&mesh, ones}, {{0, 0, 0}, {1, 1, 1}, {100, 70, 200}}, recorder);
    CHECK(recorder.seen.size() == 2 * 2 * 2);
    CHECK(recorder.repeated == 0);
    CHECK(recorder.beyond == 0);
    CHECK(recorder.empty == 0);
    for (const auto& lo : recorder.seen) {
        CHECK((lo[0] % Tile::edge == 0 && lo[1] % Tile::edge == 0 && lo[2] % Tile::edge == 0));
    }
}

TEST_CASE("Resampling reports progress and stops when asked to") {
    struct Ignore final : TileSink {
        void tile(const Tile&) override {}
    } ignore;
    const TetMesh mesh = regular({2, 2, 2}, unit);
    const std::vector<double> ones(mesh.points.size(), 1.0);
    double last = 0;
    const auto watch = [&](std::string_view, double fraction) {
        CHECK(fraction >= last);
        last = fraction;
        return true;
    };
    resample({&mesh, ones}, node_lattice(unit, 130), ignore, watch);
    CHECK(last == 1.0);
    CHECK_THROWS_AS(resample({&mesh, ones}, node_lattice(unit, 130), ignore, [](auto, double) { return false; }),
                    Cancelled);
}
