// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "interp/live_model.hpp"
#include "interp/voxels/resample.hpp"
#include "tess/cells.hpp"
#include "tess/fidelity.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;

namespace {

constexpr std::size_t soft = 0;
constexpr std::size_t hard = 1;
constexpr std::size_t rock = 2;
constexpr std::size_t below = 3;  ///< without value on the + side of the fault

/// A fault and a horizon that cross, and vertices with other values in each of the four quarters.
Model four_quarters() {
    testing::World world;
    Site& site = world.site;
    site.properties = {parse_property("soft"), parse_property("hard"), parse_property("rock:categorical"),
                       parse_property("below")};
    site.properties[hard].hard_horizons = true;
    site.properties[rock].classes = {"a", "b", "c", "d"};
    site.samples.positions = {{20, 30, 40}, {270, 260, 170}};
    site.samples.borehole = {-1, -1};
    site.samples.depth = site.samples.length = {0, 0};
    site.samples.values.assign(4, {1, 1});
    site.surfaces = {testing::planar_fault("fault", {150, 150, 100}, 10, 65, 400, 400, 20),
                     testing::planar_fault("horizon", {150, 150, 100}, 80, 5, 400, 400, 20)};
    site.surfaces[1].kind = SurfaceKind::horizon;
    world.options.extent = {{0, 0, 0}, {300, 300, 200}};
    world.options.criteria.l_min = 25;
    world.options.criteria.l_max = 100;
    world.options.barriers.spacing = 25;
    Model model = std::move(testing::build_world(world).model);
    REQUIRE(model.barriers.size() == 2);
    const BarrierQuery barriers = model_proximity(model);
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
        const Vertex& vertex = model.vertices[v];
        const auto side = [&](std::int32_t barrier) {
            const bool own = vertex.role == Role::seed && vertex.owner == barrier;
            return (own ? vertex.side : barriers.side_of(barrier, vertex.position)) > 0 ? 1.0 : 0.0;
        };
        const double quarter = 2 * side(0) + side(1);
        auto& values = model.vertex_values.values;
        values[soft][v] = values[hard][v] = values[rock][v] = quarter;
        values[below][v] = side(0) > 0 ? missing : quarter;
    }
    return model;
}

/// About the two sheets, most of them in gaps.
std::vector<Vec3> places_at(const Model& model) {
    testing::Random random(11);
    std::vector<Vec3> places;
    for (const Barrier& barrier : model.barriers) {
        for (const Triangle& t : barrier.sheet.triangles) {
            const auto& v = barrier.sheet.vertices;
            const double a = random(0.1, 0.5);
            const double b = random(0.1, 0.4);
            const Vec3 normal = cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]);
            const Vec3 p = v[t[0]] + a * (v[t[1]] - v[t[0]]) + b * (v[t[2]] - v[t[0]]) +
                           random(-0.6, 0.6) * barrier.width / length(normal) * normal;
            if (model.domain.extent.contains(p)) {
                places.push_back(p);
            }
        }
    }
    return places;
}

}  // namespace

TEST_CASE("In gaps of faults and of horizons, hard or soft, fidelity takes the value that a voxel there shows") {
    Model model = four_quarters();
    const BarrierQuery barriers = model_proximity(model);
    const TetMesh mesh = tessellate(model).mesh();
    const CellTable cells = describe_cells(model, mesh, barriers);
    const std::vector<Vec3> places = places_at(model);
    model.samples = {};
    model.samples.positions = places;
    model.samples.values.resize(4);
    std::array<std::size_t, 4> valued{};
    std::size_t blended = 0;
    for (std::size_t property = 0; property < 4; ++property) {
        const OwnSide sides(mesh, cells.barrier, barriers.seen_by(property), model.domain.extent);
        LinearField field{&mesh, model.vertex_values.values[property]};
        field.sides = &sides;
        field.categorical = property == rock;
        for (const Vec3& p : places) {
            const double voxel = resample_dense(field, {p, {1, 1, 1}, {1, 1, 1}}).front();
            model.samples.values[property].push_back(std::isnan(voxel) ? 0 : voxel);
            valued[property] += std::isnan(voxel) ? 0 : 1;
            blended += property == soft && std::abs(voxel - std::round(voxel)) > 0.01 ? 1 : 0;
            if (property == hard) {
                REQUIRE(std::abs(voxel - std::round(voxel)) < 1e-6);
            }
        }
    }
    CHECK(places.size() > 400);
    CHECK(blended > 100);  // across the horizon, which bars nothing
    CHECK(valued[soft] == places.size());
    const auto on_valued_side =
        std::ranges::count_if(places, [&](const Vec3& p) { return barriers.side_of(0, p) < 0; });
    CHECK(valued[below] == static_cast<std::size_t>(on_valued_side));
    const std::vector<Fidelity> found = fidelity(model, mesh, cells.barrier, barriers);
    for (std::size_t property = 0; property < 4; ++property) {
        INFO(model.properties[property].name);
        CHECK(found[property].count == valued[property]);
        CHECK(found[property].max < 1e-6);
    }
}

TEST_CASE("A field of one value is met whatever rounding leaves of it, and nothing is said of what it would lose") {
    testing::Random random(15);
    Site site;
    site.properties = {parse_property("v")};
    site.samples.values.resize(1);
    for (int i = 0; i < 60; ++i) {
        site.samples.positions.push_back(random.in({{0, 0, -300}, {1000, 1000, 0}}));
        site.samples.borehole.push_back(-1);
        site.samples.depth.push_back(0);
        site.samples.length.push_back(0);
        site.samples.values[0].push_back(4.9);
    }
    BuildOptions options;
    options.criteria.l_min = 200;
    BuildReport report;
    const LiveModel model(site, options, report);
    REQUIRE(report.density.deleted > 0);
    CHECK(report.fidelity[0].r2 == 1);
    for (const std::string& note : report.diagnostics.notes) {
        CHECK(note.find("explains") == std::string::npos);
    }
}
