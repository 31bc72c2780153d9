// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>

#include "tess/cells.hpp"
#include "tess/domain.hpp"
#include "tess/error.hpp"
#include "tess/mesh/quality.hpp"
#include "tess/model/density_edition.hpp"
#include "tess/progress.hpp"
#include "tess/verify.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;
using testing::build_world;
using testing::random_world;

TEST_CASE("R1: the bound is the densest packing's in the grown box") {
    // Swollen by a half on all sides, the box of 10³ has 10³ + 6·10²·½ + 3·10·π/4 + π/6.
    const double swollen = 1000 + 300 + 7.5 * M_PI + M_PI / 6;
    CHECK(packing_bound({{0, 0, 0}, {10, 10, 10}}, 1) == std::ceil(std::sqrt(2.0) * swollen));
}

TEST_CASE("Verification notices what is broken") {
    const auto failing = [](const Model& model) {
        std::vector<std::string> names;
        for (const Verdict& verdict : verify(model)) {
            if (!verdict.holds) {
                names.push_back(verdict.guarantee);
            }
        }
        return names;
    };
    testing::World world = random_world(5);
    world.options.extent = {{0, 0, -200}, {300, 300, 0}};
    const Model sound = build_world(world).model;
    REQUIRE(failing(sound).empty());

    Model model = sound;
    const auto sample = std::ranges::find(model.vertices, Role::sample, &Vertex::role);
    REQUIRE(sample != model.vertices.end());
    model.vertex_values.values[0][static_cast<std::size_t>(sample - model.vertices.begin())] = 1e6;
    CHECK_THAT(failing(model), Catch::VectorContains(std::string("V1")));

    model = sound;
    model.vertices.push_back(
        {model.vertices.back().id + 1, model.vertices.back().position + Vec3{1, 1, 1}, Role::inserted, -1, 0});
    for (auto& column : model.vertex_values.values) {
        column.push_back(0);
    }
    model.vertex_values.extrapolation.push_back(0);
    CHECK_THAT(failing(model), Catch::VectorContains(std::string("R3")));

    model = sound;
    model.criteria.l_max /= 3;
    CHECK_THAT(failing(model), Catch::VectorContains(std::string("R7")));

    model = sound;
    std::erase_if(model.vertices, [](const Vertex& v) { return v.role == Role::sample; });
    for (std::size_t i = 0; i < model.vertices.size(); ++i) {
        model.vertices[i].id = i;
    }
    CHECK_THAT(failing(model), Catch::VectorContains(std::string("D2")));
}

TEST_CASE("A site without samples and without extent cannot be built, and says so") {
    BuildReport report;
    CHECK_THROWS_AS(build({}, {}, testing::analytic_field(), report), InputError);
}

TEST_CASE("Too many vertices are refused, naming the option") {
    testing::World world = random_world(5);
    world.options.refine.max_vertices = 150;
    CHECK_THROWS_WITH(build_world(world), Catch::Contains("`max_vertices`"));
}

TEST_CASE("More vertices than allowed that only refinement shows are refused as others are, with an l_min that fits") {
    testing::World world = random_world(5);
    const testing::Built whole = build_world(world);
    const std::uint64_t initial =
        whole.model.vertices.size() - whole.report.refine.inserted + whole.report.refine.removed;
    REQUIRE(whole.report.refine.inserted > 20);
    world.options.refine.max_vertices = initial + 10;
    REQUIRE_THROWS_AS(build_world(world), UsageError);
    std::string message;
    try {
        build_world(world);
    } catch (const UsageError& e) {
        message = e.what();
    }
    CHECK_THAT(message, Catch::Contains("`max_vertices` " + std::to_string(initial + 10)) &&
                            Catch::Contains("as refinement shows"));
    const std::string before = "an `l_min` of ";
    const double wider = std::stod(message.substr(message.find(before) + before.size()));
    CHECK(wider > world.options.criteria.l_min);
}

TEST_CASE("Each step of a build that takes long can be stopped: it asks on its way") {
    testing::Random random(3);
    Samples samples;
    std::vector<Vertex> vertices;
    for (std::uint64_t i = 0; i < 5000; ++i) {
        const Vec3 p = random.in({{0, 0, 0}, {1000, 1000, 1000}});
        samples.positions.push_back(p);
        vertices.push_back({i, p, Role::sample, static_cast<std::int32_t>(i), 0});
    }
    const std::vector<Barrier> no_faults;
    const BarrierQuery proximity(no_faults);
    Criteria criteria;
    criteria.l_min = 10;
    const Domain nowhere;
    const ResolutionField resolution(criteria, nowhere, {});
    const Poll stop = [] { throw Cancelled(); };
    CHECK_THROWS_AS(face_grid({{0, 0, 0}, {1000, 1000, 1000}}, 10, 40, {}, {}, stop), Cancelled);
    for (const DensityMode mode : {DensityMode::canonical, DensityMode::paper}) {
        int asked = 0;
        CHECK_THROWS_AS(edit_density(samples, resolution, mode, proximity, stop), Cancelled);
        edit_density(samples, resolution, mode, proximity, [&] { ++asked; });
        CHECK(asked > (mode == DensityMode::paper ? 20 : 10));
    }
    Tessellation tessellation;
    CHECK_THROWS_AS(tessellation.insert(vertices, stop), Cancelled);
    Tessellation whole;
    whole.insert(vertices);
    CHECK(whole.cell_count() > 20000);
    CHECK(whole.is_delaunay());
}

TEST_CASE("Refinement can be cancelled") {
    const testing::World world = random_world(5);
    BuildReport report;
    CHECK_THROWS_AS(build(world.site, world.options, testing::analytic_field(), report,
                          [](std::string_view, double) { return false; }),
                    Cancelled);
}

TEST_CASE("A box with a finer resolution gets shorter edges, and its surroundings keep theirs") {
    testing::World world = random_world(5);
    world.site.surfaces.clear();
    world.options.extent = {{0, 0, -200}, {300, 300, 0}};
    world.options.criteria = {};
    world.options.criteria.l_min = 25;
    world.options.criteria.l_max = 100;
    const Box3 box{{150, 150, -120}, {230, 230, -60}};
    world.options.criteria.overrides = {{ResolutionOverride::Where::box, box, {}, 6, 24}};
    const Model model = build_world(world).model;
    const TetMesh mesh = tessellate(model).mesh();
    double longest_inside = 0;
    double longest_outside = 0;
    for (const auto& cell : mesh.cells) {
        const CellPoints p{mesh.points[cell[0]], mesh.points[cell[1]], mesh.points[cell[2]], mesh.points[cell[3]]};
        const bool inside = std::ranges::all_of(p, [&](const Vec3& q) { return box.contains(q); });
        double& longest = inside ? longest_inside : longest_outside;
        longest = std::max(longest, cell_quality(p).longest_edge);
    }
    CHECK(longest_inside > 12);
    CHECK(longest_inside <= 1.2 * 24);  // cells inside with their centre outside are guarded by the coarser l_min
    CHECK(longest_outside > 60);
    CHECK(longest_outside <= 100);
}

TEST_CASE("A fault block with a finer resolution gets shorter edges, up to its fault") {
    testing::World world = random_world(8);
    world.site.surfaces = {testing::planar_fault("F", {150, 150, -100}, 20, 70, 400, 400, 20)};
    world.options.extent = {{0, 0, -200}, {300, 300, 0}};
    world.options.criteria = {};
    world.options.criteria.l_min = 20;
    world.options.criteria.l_max = 90;
    const Vec3 place{40, 150, -100};
    world.options.criteria.overrides = {{ResolutionOverride::Where::block, {}, place, 10, 40}};
    const Model model = build_world(world).model;
    const TetMesh mesh = tessellate(model).mesh();
    const CellTable table = describe_cells(model, mesh);
    REQUIRE(table.region_count == 2);
    std::array<std::size_t, 2> cells{};
    std::array<std::size_t, 2> above{};
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (table.region[c] >= 0) {
            const auto& v = mesh.cells[c];
            const CellPoints p{mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]};
            const Vec3 middle = 0.25 * (p[0] + p[1] + p[2] + p[3]);
            const bool fine = !model.barriers.empty() && !BarrierQuery(model.barriers).crosses_any(middle, place);
            ++cells[static_cast<std::size_t>(fine)];
            above[static_cast<std::size_t>(fine)] += cell_quality(p).longest_edge > 40;
        }
    }
    CHECK(above[1] * 10 < cells[1]);      // but where the fault or the box forbids
    CHECK(above[0] * 10 > cells[0] * 2);  // the other block has its own
    CHECK(cells[1] > 2 * cells[0]);

    world.options.criteria.overrides[0].point = {150, 150, -100};  // on the fault
    CHECK_THROWS_WITH(build_world(world), Catch::Contains("fault block"));
}
