// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <numeric>

#include "tess/cells.hpp"
#include "tess/domain.hpp"
#include "tess/mesh/mesh_walk.hpp"
#include "tess/mesh/quality.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;

namespace {

const Box3 extent{{0, 0, -200}, {300, 300, 0}};

testing::World quiet_world(const std::vector<Surface>& faults) {
    testing::World world = testing::random_world(5);
    world.site.surfaces = faults;
    world.options.extent = extent;
    world.options.criteria = {};
    world.options.criteria.l_min = 15;
    world.options.criteria.l_max = 60;
    return world;
}

std::map<std::int32_t, double> region_volumes(const TetMesh& mesh, const CellTable& table) {
    std::map<std::int32_t, double> volumes;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const auto& v = mesh.cells[c];
        volumes[table.region[c]] +=
            cell_quality({mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]}).volume;
    }
    return volumes;
}

}  // namespace

TEST_CASE("A fault through the whole extent makes two regions of the right size; a half fault leaves one") {
    const auto through = testing::planar_fault("through", {150, 150, -100}, 0, 90, 500, 400, 15);
    const auto built = testing::build_world(quiet_world({through}));
    REQUIRE(built.model.barriers.size() == 1);
    const TetMesh mesh = tessellate(built.model).mesh();
    const CellTable table = describe_cells(built.model, mesh);
    CHECK(table.region_count == 2);
    CHECK(built.report.final.regions == 2);
    CHECK(built.report.final.gap_tetrahedra > 100);
    const auto volumes = region_volumes(mesh, table);
    const double half = extent.volume() / 2;
    CHECK(volumes.at(0) == Approx(half).epsilon(0.08));  // cells belong by their centroid: ragged at the extent's faces
    CHECK(volumes.at(1) == Approx(half).epsilon(0.08));
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        const auto& v = mesh.cells[c];
        const double x = (mesh.points[v[0]].x + mesh.points[v[1]].x + mesh.points[v[2]].x + mesh.points[v[3]].x) / 4;
        if (table.region[c] >= 0 && std::abs(x - 150) > 15) {
            const bool west = x < 150;
            const bool first_is_west = mesh.points[mesh.cells[static_cast<std::size_t>(
                                                       std::ranges::find(table.region, 0) - table.region.begin())][0]]
                                           .x < 150;
            REQUIRE((table.region[c] == 0) == (west == first_is_west));
        }
    }

    const auto half_fault = testing::planar_fault("half", {150, 150, -100}, 0, 90, 60, 50, 15);
    const auto other = testing::build_world(quiet_world({half_fault}));
    REQUIRE(other.model.barriers.size() == 1);
    CHECK(other.report.final.regions == 1);
}

TEST_CASE("Percentages count what their names say") {
    auto world = quiet_world({});
    world.options.refine_enabled = false;
    const auto built = testing::build_world(world);
    const TetMesh mesh = tessellate(built.model).mesh();
    std::size_t skinny = 0;
    std::size_t flat = 0;
    for (const auto& v : mesh.cells) {
        const CellQuality q =
            cell_quality({mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]});
        skinny += q.radius_edge > 2 ? 1 : 0;
        flat += q.radius_edge <= 2 && q.aspect > 8 ? 1 : 0;
    }
    const auto percent = [&](std::size_t n) {
        return 100.0 * static_cast<double>(n) / static_cast<double>(mesh.cells.size());
    };
    CHECK(built.report.final.tetrahedra == mesh.cells.size());
    CHECK(built.report.final.skinny_percent == Approx(percent(skinny)));
    CHECK(built.report.final.flat_percent == Approx(percent(flat)));
    CHECK(built.report.final.bad_percent >= built.report.final.skinny_percent + built.report.final.flat_percent - 1e-9);
    CHECK(skinny > 0);
}

TEST_CASE("Edges are those of all cells in the extent, in a fault's gap too") {
    auto world = quiet_world({testing::planar_fault("through", {150, 150, -100}, 0, 90, 500, 400, 15)});
    world.options.barriers.width = 3;
    const auto built = testing::build_world(world);
    const TetMesh mesh = tessellate(built.model).mesh();
    const CellTable table = describe_cells(built.model, mesh);
    double shortest = 1e9;
    double longest = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        for (std::size_t i = 0; table.in_extent[c] != 0 && i < 4; ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const double length = distance(mesh.points[mesh.cells[c][i]], mesh.points[mesh.cells[c][j]]);
                shortest = std::min(shortest, length);
                longest = std::max(longest, length);
            }
        }
    }
    CHECK(built.report.final.edge_min == Approx(shortest));
    CHECK(built.report.final.edge_max == Approx(longest));
    CHECK(built.report.final.edge_min < 3.1);  // a pair of seeds
}

TEST_CASE("Refinement leaves few bad cells where the criteria can be met") {
    const auto built = testing::build_world(quiet_world({}));
    CHECK(built.report.initial.bad_percent > 50);
    CHECK(built.report.final.bad_percent < 1);
    CHECK(built.report.final.dihedral_p1_deg > 12);
    std::uint64_t bad = 0;
    for (const auto& [reason, count] : built.report.refine.skipped) {
        bad += count;
    }
    CHECK(static_cast<double>(bad) >=
          built.report.final.bad_percent / 100 * static_cast<double>(built.report.final.tetrahedra) - 1);
}

TEST_CASE("A linear field is reproduced at every sample, dropped ones included") {
    auto world = quiet_world({});
    world.site.properties[0] = parse_property("T");
    const auto linear = [](const Vec3& p) { return 3 + 0.01 * p.x - 0.02 * p.y + 0.005 * p.z; };
    for (std::size_t i = 0; i < world.site.samples.size(); ++i) {
        world.site.samples.values[0][i] = linear(world.site.samples.positions[i]);
        world.site.samples.values[1][i] = missing;
    }
    BuildReport report;
    const auto built = build(
        world.site, world.options,
        [&](const Model&, const BarrierQuery&) {
            return [&](std::span<const ValueQuery> queries) {
                ValueBatch batch{{{}, std::vector<double>(queries.size(), missing)},
                                 std::vector<double>(queries.size(), 0)};
                for (const ValueQuery& query : queries) {
                    batch.values[0].push_back(linear(query.position));
                }
                return batch;
            };
        },
        report);
    const Model& model = built->model;
    REQUIRE(report.fidelity.size() == 2);
    CHECK(report.fidelity[0].count == model.samples.size());
    CHECK(report.fidelity[0].count > report.density.kept.size());
    CHECK(report.fidelity[0].max < 1e-9);
    CHECK(report.fidelity[1].count == 0);
}

TEST_CASE("Point location finds the cell, or nothing outside") {
    const auto built = testing::build_world(quiet_world({}));
    const TetMesh mesh = tessellate(built.model).mesh();
    MeshWalk walk(mesh);
    testing::Random random(4);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p = random.in(extent.grown(30));
        const auto position = walk.locate(p);
        REQUIRE(position.has_value() == extent.contains(p));
        if (position) {
            Vec3 sum;
            for (std::size_t k = 0; k < 4; ++k) {
                sum = sum + position->weights[k] * mesh.points[mesh.cells[position->cell][k]];
            }
            REQUIRE(distance(sum, p) < 1e-9);
        }
    }
}

TEST_CASE("The grid on the hull box's faces is fine enough, never too fine, and keeps clear of obstacles") {
    const Frame frame;
    testing::Random random(9);
    for (int round = 0; round < 30; ++round) {
        const Box3 hull{{0, 0, 0}, {random(50, 400), random(50, 400), random(50, 400)}};
        const double l_min = random(5, 30);
        const double l_max = l_min * random(1.5, 6);
        std::vector<Vec3> obstacles;
        for (int i = 0; i < 20; ++i) {
            obstacles.push_back(random.in(hull));
        }
        const auto points = face_grid(hull, l_min, l_max, obstacles, frame);
        int corners = 0;
        for (const Vec3& p : points) {
            const auto on = [&](int axis) { return p[axis] == hull.lo[axis] || p[axis] == hull.hi[axis]; };
            REQUIRE((on(0) || on(1) || on(2)));
            const bool corner = on(0) && on(1) && on(2);
            corners += corner ? 1 : 0;
            for (const Vec3& q : obstacles) {
                REQUIRE((corner || distance(p, q) >= l_min));
            }
            for (const Vec3& q : points) {
                REQUIRE((p == q || distance(p, q) >= l_min * (1 - 1e-12)));
            }
        }
        CHECK(corners == 8);
        const auto free = face_grid(hull, l_min, l_max, {}, frame);
        for (int i = 0; i < 200;
             ++i) {  // covering: a square grid of spacing l_max/√2 leaves half its diagonal, l_max/2
            Vec3 p = random.in(hull);
            p.x = hull.lo.x;
            double nearest = 1e300;
            for (const Vec3& q : free) {
                nearest = std::min(nearest, distance(p, q));
            }
            REQUIRE(nearest <= std::max(l_max / 2, 2 * l_min / std::sqrt(2.0)) + 1e-9);
        }
    }
}
