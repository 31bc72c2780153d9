// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/mending/mend_cells.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <set>

#include "kuhn_mesh.hpp"
#include "support.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

double six_volumes(const MendableMesh& mesh, const MendableMesh::Cell& cell) {
    const auto& [a, b, c, d] = cell.corners;
    const auto& p = mesh.points;
    return dot(cross(p[b] - p[a], p[c] - p[a]), p[d] - p[a]);
}

/// Two blocks of a lattice that meet at x = 40, its inner points moved at random until many cells are thin.
MendableMesh shaken_lattice(std::uint64_t seed, double by) {
    Random random(seed);
    MendableMesh mesh;
    mesh.box = {{0, 0, 0}, {80, 80, 80}};
    mesh.least_edge = 2;
    const TetMesh lattice = kuhn_mesh({8, 8, 8}, [&](const Node& n) {
        Vec3 p{10.0 * n[0], 10.0 * n[1], 10.0 * n[2]};
        for (int axis = 0; axis < 3; ++axis) {
            const bool stays = p[axis] == 0 || p[axis] == 80 || (axis == 0 && p.x == 40);
            p[axis] += stays ? 0 : random(-by, by);
        }
        return p;
    });
    mesh.points = lattice.points;
    for (const Vec3& p : mesh.points) {
        mesh.hold.push_back(p.x == 40 ? MendableMesh::Hold::fixed : MendableMesh::Hold::free);
    }
    for (std::uint32_t c = 0; c < lattice.cells.size(); ++c) {
        const auto& v = lattice.cells[c];
        const double x = mesh.points[v[0]].x + mesh.points[v[1]].x + mesh.points[v[2]].x + mesh.points[v[3]].x;
        mesh.cells.push_back({v, c, x < 160 ? 0 : 1, true, true});
    }
    return mesh;
}

/// Facets of one cell, or of two that are of different parts.
std::map<Triangle, int> walls(const MendableMesh& mesh) {
    std::map<Triangle, std::pair<int, int>> sides;  // cells, sum of parts
    for (const MendableMesh::Cell& cell : mesh.cells) {
        for (const auto& o : facet_corners) {
            Triangle key{cell.corners[o[0]], cell.corners[o[1]], cell.corners[o[2]]};
            std::ranges::sort(key);
            ++sides[key].first;
            sides[key].second += cell.part;
        }
    }
    std::map<Triangle, int> result;
    for (const auto& [key, side] : sides) {
        REQUIRE(side.first <= 2);
        if (side.first == 2 && side.second == 1) {
            result[key] = 1;
        } else if (side.first == 1) {
            bool on_face = false;
            for (int axis = 0; axis < 3; ++axis) {
                for (const double at : {0.0, 80.0}) {
                    on_face |= std::ranges::all_of(key, [&](std::uint32_t v) { return mesh.points[v][axis] == at; });
                }
            }
            REQUIRE(on_face);
        }
    }
    return result;
}

double worst(const MendableMesh& mesh) {
    MendableMesh copy = mesh;
    const MendableStars stars(copy);
    double result = 1;
    for (const MendableMesh::Cell& cell : mesh.cells) {
        result = std::min(result, stars.goodness(cell));
    }
    return result;
}

}  // namespace

TEST_CASE("Mending makes the worst cell better, fills the same box, and leaves what parts two blocks as it is") {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        MendableMesh mesh = shaken_lattice(seed, 2.8);
        std::erase_if(mesh.cells, [&](const MendableMesh::Cell& cell) { return cell.corners == Corners{}; });
        const auto before = walls(mesh);
        REQUIRE(std::ranges::all_of(mesh.cells, [&](const auto& cell) { return six_volumes(mesh, cell) > 0; }));
        const double sharpest = worst(mesh);
        mend_cells(mesh);
        std::erase_if(mesh.cells, [](const MendableMesh::Cell& cell) { return MendableStars::gone(cell); });
        CHECK(worst(mesh) > 0.05);  // 13°
        CHECK(worst(mesh) > 2 * sharpest);
        CHECK(walls(mesh) == before);
        double volumes = 0;
        std::array<double, 2> of_part{};
        for (const MendableMesh::Cell& cell : mesh.cells) {
            REQUIRE(six_volumes(mesh, cell) > 0);
            volumes += six_volumes(mesh, cell) / 6;
            of_part[static_cast<std::size_t>(cell.part)] += six_volumes(mesh, cell) / 6;
        }
        CHECK(volumes == Approx(80.0 * 80 * 80).epsilon(1e-12));
        CHECK(of_part[0] == Approx(volumes / 2).epsilon(1e-12));
    }
}
