// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tess/cells.hpp"
#include "tess/collapse.hpp"
#include "tess/error.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;

namespace {

testing::World split_world(const std::vector<RegionName>& names) {
    testing::World world = testing::random_world(5);
    world.site.surfaces = {testing::planar_fault("a", {80, 150, -100}, 0, 90, 500, 400, 15),
                           testing::planar_fault("b", {220, 150, -100}, 0, 90, 500, 400, 15)};
    world.options.extent = {{0, 0, -200}, {300, 300, 0}};
    world.options.criteria = {};
    world.options.criteria.l_min = 15;
    world.options.criteria.l_max = 60;
    world.options.region_names = names;
    return world;
}

}  // namespace

TEST_CASE("A region has the name that one of its points was given, also when faults are collapsed") {
    const auto built = testing::build_world(split_world({{{290, 20, -20}, "east"}, {{150, 150, -100}, "graben"}}));
    const TetMesh mesh = tessellate(built.model).mesh();
    const CellTable cells = describe_cells(built.model, mesh);
    const CollapsedModel collapsed = collapse_faults(built.model, mesh, cells);
    REQUIRE(cells.region_count == 3);
    REQUIRE(cells.region_name.size() == 3);
    CHECK(collapsed.cells.region_name == cells.region_name);
    std::size_t unnamed = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
        if (cells.region[c] < 0) {
            continue;
        }
        double x = 0;
        for (const std::uint32_t v : mesh.cells[c]) {
            x += mesh.points[v].x / 4;
        }
        const auto region = static_cast<std::size_t>(cells.region[c]);
        const std::string& name = cells.region_name[region];
        REQUIRE(name == (x > 220 ? "east" : x > 80 ? "graben" : "region " + std::to_string(region)));
        unnamed += x < 80 ? 1 : 0;
    }
    CHECK(unnamed > 0);
}

TEST_CASE("A wall with a hole in it parts nothing, however small the hole") {
    const auto regions = [](double from, double to, bool edge) {
        testing::World world = split_world({});
        Surface wall = testing::planar_fault("a", {150, 150, -100}, 0, 90, 500, 400, 10);
        std::erase_if(wall.triangles, [&](const Triangle& t) {
            const Vec3 middle = (wall.vertices[t[0]] + wall.vertices[t[1]] + wall.vertices[t[2]]) / 3;
            return middle.y > from && middle.y < to && (edge ? middle.z < -120 : middle.z > -130 && middle.z < -70);
        });
        world.site.surfaces = {wall};
        return testing::build_world(world).report.final.regions;
    };
    CHECK(regions(0, 0, false) == 2);
    CHECK(regions(150, 210, false) == 1);  // ten cells wide
    CHECK(regions(150, 180, false) == 1);  // the margins of its sides cover each other
    CHECK(regions(150, 180, true) == 1);   // a slit from below
    CHECK(regions(-90, -40, false) == 2);  // beyond the extent
}

TEST_CASE("A name that belongs to no region, or a region with two names, is a mistake") {
    using Catch::Matchers::Contains;
    CHECK_THROWS_AS(testing::build_world(split_world({{{290, 20, 50}, "sky"}})), UsageError);
    CHECK_THROWS_WITH(testing::build_world(split_world({{{80, 150, -100}, "fault"}})), Contains("'fault' lies in no"));
    CHECK_THROWS_WITH(testing::build_world(split_world({{{10, 20, -20}, "one"}, {{20, 20, -90}, "two"}})),
                      Contains("'one' and 'two' name the same region"));
}
