// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/natural/surroundings.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "estimation.hpp"
#include "sites.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

struct Looks {
    std::size_t asked_most = 0;
    int axes_least = 3, axes_most = 0;  ///< that are determined
    std::size_t strangers = 0;          ///< seen, but farther away than `near`
};

Looks look_around(const std::vector<Vec3>& sites, const BarrierQuery* barriers = nullptr, double near = INFINITY) {
    const SiteMesh mesh(sites, barriers);
    const SheetSides sides(mesh);
    const Stars stars(mesh.tessellation());
    Looks out;
    for (std::int32_t site = 0; site < mesh.tessellation().site_count(); site += 7) {
        Surroundings surroundings(mesh, sides, stars, site);
        const auto& seen = surroundings.look();
        const Spread spread(seen);
        const int axes = spread.determines(0) + spread.determines(1) + spread.determines(2);
        out.asked_most = std::max(out.asked_most, surroundings.asked());
        out.axes_least = std::min(out.axes_least, axes);
        out.axes_most = std::max(out.axes_most, axes);
        for (const Seen& s : seen) {
            out.strangers += s.offset.head<2>().norm() > near;
        }
    }
    return out;
}

std::vector<Vec3> undulating(std::vector<Vec3> sites, double height) {
    for (Vec3& p : sites) {
        p.z += height * std::sin(p.x / 37) * std::cos(p.y / 53);
    }
    return sites;
}

std::vector<Vec3> line_sites(std::size_t count) {
    std::vector<Vec3> sites(count);
    for (std::size_t i = 0; i < count; ++i) {
        sites[i].x = 10 * static_cast<double>(i);
    }
    return sites;
}

/// One well in the middle of each of side × side compartments, 100 across.
std::vector<Vec3> wells_apart(int side, int samples) {
    std::vector<Vec3> sites;
    for (const Vec3& at : square_sites(side, 100)) {
        for (int k = 0; k < samples; ++k) {
            sites.push_back({at.x + 0.01 * std::sin(k), at.y + 0.01 * std::cos(3 * k), 2.0 * k});
        }
    }
    return sites;
}

std::vector<Barrier> walls_between(int side) {
    std::vector<Barrier> walls;
    for (int i = 1; i < side; ++i) {
        Barrier wall = fault_at_x(100 * i - 50, -5000, 5000);
        wall.spacing = 10;
        walls.push_back(wall);
        for (Vec3& p : wall.sheet.vertices) {
            std::swap(p.x, p.y);
        }
        walls.push_back(wall);
    }
    return walls;
}

}  // namespace

TEST_CASE("Among samples on a plane or a line no site looks for directions that none of them has") {
    for (const auto& sites : {square_sites(50, 10), tilted(square_sites(50, 10)), undulating(square_sites(50, 10), 0.1),
                              tilted(undulating(square_sites(50, 10), 0.1))}) {
        const Looks looks = look_around(sites);
        CHECK(looks.asked_most < 100);
        CHECK(looks.axes_least == 2);
        CHECK(looks.axes_most == 2);
    }
    for (const auto& sites : {line_sites(2500), tilted(line_sites(2500))}) {
        const Looks looks = look_around(sites);
        CHECK(looks.asked_most < 20);
        CHECK(looks.axes_least == 1);
        CHECK(looks.axes_most == 1);
    }
}

TEST_CASE("Samples that are nearly on a plane still find their third direction where it takes more rings") {
    const auto sites = undulating(square_sites(50, 10), 9);
    CHECK(look_around(sites).axes_least == 3);
    CHECK(look_around(tilted(sites)).axes_least == 3);
}

TEST_CASE("A site that barriers leave alone with its well does not ask for all others") {
    const auto walls = walls_between(6);
    const BarrierQuery barriers(walls);
    const auto sites = wells_apart(6, 120);
    const Looks looks = look_around(sites, &barriers, 1);
    CHECK(looks.asked_most < sites.size() / 2);
    CHECK(looks.strangers == 0);
    CHECK(looks.axes_most == 1);
}
