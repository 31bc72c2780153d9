// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/cavity.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "interp/base/morton.hpp"
#include "sites.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

CompactDelaunay mesh_of(const std::vector<Vec3>& sites) {
    std::vector<Vec3> sorted;
    for (const std::uint32_t i : morton_order(sites)) {
        sorted.push_back(sites[i]);
    }
    return CompactDelaunay(sorted);
}

std::vector<std::int32_t> cells_in_conflict(const CompactDelaunay& mesh, const Vec3& q) {
    std::vector<std::int32_t> cells;
    for (std::size_t c = 0; c < mesh.cells().size(); ++c) {
        if (mesh.in_conflict(mesh.cells()[c], q)) {
            cells.push_back(static_cast<std::int32_t>(c));
        }
    }
    return cells;
}

}  // namespace

TEST_CASE("A place on cells' facets has its whole conflict zone, whatever cell the walk came to and however large") {
    const CompactDelaunay mesh = mesh_of(square_sites(60, 10));
    std::size_t largest = 0;
    // On the planes of the lattice and of the ghosts: several cells contain each.
    for (const Vec3& q : {Vec3{300, 300, -40}, Vec3{295, 295, -200}, Vec3{-200, -200, 0}, Vec3{40, 300, 120}}) {
        CAPTURE(q.x, q.y, q.z);
        const auto expected = cells_in_conflict(mesh, q);
        largest = std::max(largest, expected.size());
        Cavity first;
        for (const std::int32_t start : expected) {
            if (start % 500 != 0 && start != expected.front()) {
                continue;
            }
            const auto at = mesh.locate(q, start);
            Cavity cavity;
            cavity.find(mesh, q, at);
            auto found = cavity.all_cells(mesh);
            std::sort(found.begin(), found.end());
            REQUIRE(found == expected);
            REQUIRE(cavity.facets.size() == 2 * cavity.vertices.size() - 4);  // its boundary is a sphere
            if (!at.strictly_inside) {
                if (first.vertices.empty()) {
                    first = cavity;
                }
                REQUIRE(cavity.cells == first.cells);
                REQUIRE(cavity.groups == first.groups);
                REQUIRE(cavity.vertices == first.vertices);
            }
        }
    }
    CHECK(largest > 4000);
}
