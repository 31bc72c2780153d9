// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mesh/tile.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <set>

#include "tess/tessellation.hpp"

using namespace terratet;

namespace {

using Corners = std::array<std::uint64_t, 4>;  // ids

constexpr double side = 100;
const Box3 hull{{0, 0, 0}, {side, side, side}};

enum class Kind { random, clustered, lattice };

/// The hull's corners, then points of a kind; distinct.
std::vector<Vertex> points_of(Kind kind, std::size_t count, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(0, side);
    std::normal_distribution<double> normal(0, 2);
    std::vector<Vertex> all;
    const auto add = [&](const Vec3& p) {
        if (hull.contains(p) && std::ranges::none_of(all, [&](const Vertex& v) { return v.position == p; })) {
            all.push_back({all.size() + 1, p});
        }
    };
    for (unsigned n = 0; n < 8; ++n) {
        add({(n & 1U) != 0 ? side : 0, (n & 2U) != 0 ? side : 0, (n & 4U) != 0 ? side : 0});
    }
    std::array<Vec3, 5> middles{};
    for (Vec3& middle : middles) {
        middle = {uniform(random), uniform(random), uniform(random)};
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (kind == Kind::random || (kind == Kind::clustered && i % 10 == 0)) {
            add({uniform(random), uniform(random), uniform(random)});
        } else if (kind == Kind::clustered) {
            add(middles[i % 5] + Vec3{normal(random), normal(random), normal(random)});
        } else {  // many on a sphere: ties everywhere
            add(12.5 * Vec3{std::round(uniform(random) / 12.5), std::round(uniform(random) / 12.5),
                            std::round(uniform(random) / 12.5)});
        }
    }
    return all;
}

bool meets(const TetMesh& mesh, const std::array<std::uint32_t, 4>& cell, const Box3& tile) {
    Box3 box;
    for (const auto v : cell) {
        box.extend(mesh.points[v]);
    }
    return box.lo.x <= tile.hi.x && box.hi.x >= tile.lo.x && box.lo.y <= tile.hi.y && box.hi.y >= tile.lo.y &&
           box.lo.z <= tile.hi.z && box.hi.z >= tile.lo.z;
}

std::set<Corners> cells_meeting(const TetMesh& mesh, std::span<const Vertex> vertices, const Box3& tile) {
    std::set<Corners> out;
    for (const auto& cell : mesh.cells) {
        if (meets(mesh, cell, tile)) {
            out.insert({vertices[cell[0]].id, vertices[cell[1]].id, vertices[cell[2]].id, vertices[cell[3]].id});
        }
    }
    return out;
}

double volume(const std::vector<Vertex>& all, const Corners& cell) {
    const auto at = [&](std::size_t k) { return all[cell[k] - 1].position; };
    return dot(cross(at(1) - at(0), at(2) - at(0)), at(3) - at(0)) / 6;
}

bool holds(const std::vector<Vertex>& all, const Corners& cell, const Vec3& p) {
    for (std::size_t k = 0; k < 4; ++k) {
        std::array<Vec3, 4> corners;
        for (std::size_t other = 0; other < 4; ++other) {
            corners[other] = other == k ? p : all[cell[other] - 1].position;
        }
        if (dot(cross(corners[1] - corners[0], corners[2] - corners[0]), corners[3] - corners[0]) < -1e-6) {
            return false;
        }
    }
    return true;
}

/// Is each of 30 random places of the tile in a cell?
bool covers(const std::vector<Vertex>& all, const std::set<Corners>& cells, const Box3& tile, std::mt19937_64& random) {
    for (int n = 0; n < 30; ++n) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            p[axis] = std::uniform_real_distribution<double>(tile.lo[axis], tile.hi[axis])(random);
        }
        if (std::ranges::none_of(cells, [&](const Corners& cell) { return holds(all, cell, p); })) {
            return false;
        }
    }
    return true;
}

}  // namespace

TEST_CASE("S1: a tile's cells are those of the whole tessellation, and tiles cover it") {
    std::mt19937_64 random(7);
    int grown = 0;
    for (int tiling = 0; tiling < 200; ++tiling) {
        const auto kind = static_cast<Kind>(tiling % 3);
        const std::vector<Vertex> all = points_of(kind, 150 + random() % 200, random);
        Tessellation whole;
        whole.insert(all);
        const TetMesh mesh = whole.mesh();
        Vec3 cut;
        for (int axis = 0; axis < 3; ++axis) {
            cut[axis] = std::uniform_real_distribution<double>(10, 90)(random);
        }
        std::set<Corners> together;
        for (unsigned n = 0; n < 8; ++n) {
            Box3 tile = hull;
            for (int axis = 0; axis < 3; ++axis) {
                ((n >> axis & 1U) != 0 ? tile.lo : tile.hi)[axis] = cut[axis];
            }
            const Tile found =
                tessellate_tile(tile, hull, 4 + static_cast<double>(random() % 20), [&](const Box3& box) {
                    std::vector<Vertex> in;
                    std::ranges::copy_if(all, std::back_inserter(in),
                                         [&](const auto& v) { return box.contains(v.position); });
                    return in;
                });
            grown += found.grown;
            const auto cells = cells_meeting(found.mesh, found.vertices, tile);
            REQUIRE(cells.size() == found.mesh.cells.size());
            REQUIRE(std::ranges::includes(cells_meeting(mesh, all, tile), cells));
            REQUIRE(covers(all, cells, tile, random));
            together.insert(cells.begin(), cells.end());
        }
        REQUIRE(together.size() == mesh.cells.size());
        double sum = 0;
        for (const Corners& cell : together) {
            REQUIRE(volume(all, cell) > 0);
            sum += volume(all, cell);
        }
        REQUIRE(sum == Approx(side * side * side).epsilon(1e-12));
    }
    CHECK(grown > 100);  // halos that were too small were found to be
}

TEST_CASE("a tile in the middle of many vertices reads few of them") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0, side);
    std::vector<Vertex> all;
    for (unsigned n = 0; n < 8; ++n) {
        all.push_back({n + 1, {(n & 1U) != 0 ? side : 0, (n & 2U) != 0 ? side : 0, (n & 4U) != 0 ? side : 0}});
    }
    while (all.size() < 20000) {
        all.push_back({all.size() + 1, {uniform(random), uniform(random), uniform(random)}});
    }
    const Tile tile = tessellate_tile({{45, 45, 45}, {55, 55, 55}}, hull, 12, [&](const Box3& box) {
        std::vector<Vertex> in;
        std::ranges::copy_if(all, std::back_inserter(in), [&](const auto& v) { return box.contains(v.position); });
        return in;
    });
    CHECK(tile.grown <= 1);
    CHECK(tile.vertices.size() < all.size() / 4);
    CHECK(tile.mesh.cells.size() > 100);
}

TEST_CASE("a cell that is flat but for rounding is no reason to read on when all is read") {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int n = 0; n < 100; ++n) {
        std::vector<Vertex> all = points_of(Kind::random, 0, random);
        const Vec3 u = 25.0 * Vec3{uniform(random), uniform(random), uniform(random)};
        const Vec3 v = cross(u, Vec3{uniform(random), uniform(random), uniform(random)});
        const Vec3 w = (length(u) / length(v)) * v;
        for (const Vec3& arm : {u, w, -1 * u, -1 * w}) {  // a square, in no plane of ours
            all.push_back({all.size() + 1, Vec3{50, 50, 50} + arm});
        }
        int reads = 0;
        const Box3 middle{{40, 40, 40}, {60, 60, 60}};
        const Tile tile = tessellate_tile(middle, hull, 200, [&](const Box3&) {
            REQUIRE(++reads < 10);
            return all;
        });
        Tessellation whole;
        whole.insert(all);
        CHECK(cells_meeting(tile.mesh, tile.vertices, middle) == cells_meeting(whole.mesh(), all, middle));
    }
}
