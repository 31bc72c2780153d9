// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/cut_cells.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <numeric>

#include "kuhn_mesh.hpp"
#include "support.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

/// A block of 3 × 2 × 4 boxes over the unit cube, its inner nodes moved.
TetMesh shaken_cube(Random& random) {
    const Node boxes{3, 2, 4};
    return kuhn_mesh(boxes, [&](const Node& n) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<std::size_t>(axis);
            p[axis] = static_cast<double>(n[k]) / boxes[k];
            p[axis] += n[k] > 0 && n[k] < boxes[k] ? random(-0.05, 0.05) : 0;
        }
        return p;
    });
}

double volume_of(const TetMesh& mesh, const CellCorners& v) {
    const Vec3& d = mesh.points[v[3]];
    return std::abs(dot(mesh.points[v[0]] - d, cross(mesh.points[v[1]] - d, mesh.points[v[2]] - d))) / 6;
}

/// Of the unit cube below a plane with positive components: by inclusion and exclusion of the corners' tips.
double cube_below(const CutPlane& plane) {
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
        double rest = plane.offset;
        int bits = 0;
        for (int axis = 0; axis < 3; ++axis) {
            if ((i >> axis & 1) != 0) {
                rest -= plane.normal[axis];
                ++bits;
            }
        }
        sum += (bits % 2 != 0 ? -1 : 1) * std::pow(std::max(0.0, rest), 3);
    }
    return sum / (6 * plane.normal.x * plane.normal.y * plane.normal.z);
}

/// Of the cut's area the derivative, for a unit normal.
double cube_section(const CutPlane& plane) {
    constexpr double h = 1e-5;
    return (cube_below({plane.normal, plane.offset + h}) - cube_below({plane.normal, plane.offset - h})) / (2 * h);
}

}  // namespace

TEST_CASE("A plane's section of a cube of cells covers the cube's own section once, looking along the normal") {
    Random random(17);
    for (int round = 0; round < 50; ++round) {
        const TetMesh mesh = shaken_cube(random);
        Vec3 normal{random(0.1, 1), random(0.1, 1), random(0.1, 1)};
        normal = normal / length(normal);
        const CutPlane plane = CutPlane::through({random(0.2, 0.8), random(0.2, 0.8), random(0.2, 0.8)}, normal);
        const CellCut cut = cut_cells(mesh.points, mesh.cells, plane);
        const std::vector<Vec3> at = cut.positions(mesh.points);
        double area = 0;
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (const Triangle& t : cut.triangles) {
            const Vec3 twice = cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);
            REQUIRE(dot(twice, normal) > 0);
            area += length(twice) / 2;
            for (std::size_t k = 0; k < 3; ++k) {
                ++edges[std::minmax(t[k], t[(k + 1) % 3])];
            }
        }
        CHECK(area == Approx(cube_section(plane)).epsilon(1e-6));
        for (const auto& [edge, times] : edges) {
            REQUIRE(times <= 2);  // conforming
        }
        for (const Vec3& p : at) {
            REQUIRE(std::abs(plane.distance(p)) < 1e-12);
        }
    }
}

TEST_CASE("A section through a mesh's own facets has each facet once") {
    const TetMesh mesh = kuhn_mesh({2, 2, 2}, [](const Node& n) { return Vec3{n[0] / 2.0, n[1] / 2.0, n[2] / 2.0}; });
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 normal;
        normal[axis] = 1;
        const CellCut cut = cut_cells(mesh.points, mesh.cells, {normal, 0.5});
        CHECK(cut.triangles.size() == 8);
        for (const auto& corner : cut.corners) {
            CHECK(corner.a == corner.b);
        }
    }
}

TEST_CASE("The cells' shares above a plane add up to the cube's volume above it") {
    Random random(5);
    for (int round = 0; round < 50; ++round) {
        const TetMesh mesh = shaken_cube(random);
        const CutPlane plane{{random(0.1, 1), random(0.1, 1), random(0.1, 1)}, random(-0.1, 2)};
        double above = 0;
        for (const CellCorners& cell : mesh.cells) {
            std::array<double, 4> level{};
            std::transform(cell.begin(), cell.end(), level.begin(),
                           [&](std::uint32_t v) { return plane.distance(mesh.points[v]); });
            above += share_above(level, 0) * volume_of(mesh, cell);
        }
        CHECK(above == Approx(1 - cube_below(plane)).margin(1e-12));
    }
}

TEST_CASE("The share above a level is whole, none, or unknown where it must be") {
    CHECK(share_above({1, 1, 1, 1}, 1) == 1);
    CHECK(share_above({1, 1, 1, 1}, 1.5) == 0);
    CHECK(share_above({0, 0, 2, 2}, 1) == Approx(0.5));
    CHECK(share_above({0, 1, 1, 1}, 1) == 0);  // but for the facet itself
    CHECK(std::isnan(share_above({0, 1, std::numeric_limits<double>::quiet_NaN(), 1}, 1)));
}

TEST_CASE("An isosurface runs where the property's scale has the value, and not through cells without a value") {
    Random random(9);
    const TetMesh mesh = shaken_cube(random);
    Property grade;
    grade.scale = Scale::log10;
    std::vector<double> measured;
    std::vector<double> level;
    for (const Vec3& p : mesh.points) {
        measured.push_back(std::pow(10, 3 * p.x - 1));
        level.push_back(to_scale(grade, measured.back()));
    }
    const CellCut cut = cut_cells(mesh.cells, level, to_scale(grade, 2));
    REQUIRE_FALSE(cut.triangles.empty());
    for (const double value : cut.values(grade, measured)) {
        CHECK(value == Approx(2).epsilon(1e-12));
    }
    for (const Vec3& p : cut.positions(mesh.points)) {
        CHECK(p.x == Approx((std::log10(2.0) + 1) / 3));
    }
    std::vector<std::uint8_t> left_out(mesh.cells.size(), 0);
    left_out[cut.cell.front()] = 1;
    CHECK(cut_cells(mesh.cells, level, to_scale(grade, 2), left_out).triangles.size() < cut.triangles.size());
    level.assign(level.size(), std::numeric_limits<double>::quiet_NaN());
    CHECK(cut_cells(mesh.cells, level, 0).triangles.empty());
}
