// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/close_crossings.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tess/tessellation.hpp"
#include "tests/tess/fault_cases.hpp"

namespace terratet {
namespace {

const Box3 extent{{0, 0, 0}, {400, 400, 400}};
constexpr double spacing = 20;

/// A fault that rises at 20 degrees from the middle of another, without the flakes that seal the wedge.
Model leaking_wedge() {
    const double angle = 20 * std::numbers::pi / 180;
    const Vec3 up{std::cos(angle), 0, std::sin(angle)};
    const std::vector<Surface> surfaces{testing::rectangle("main", {200, 200, 200}, {600, 0, 0}, {0, 500, 0}),
                                        testing::gridded("branch", 1, 1, [&](double u, double v) {
                                            return Vec3{200, -300 + 1000 * u, 200} + 600 * v * up;
                                        })};
    BarrierOptions options;
    options.mode = SeedMode::exact;
    Model model;
    model.domain.extent = extent;
    model.domain.hull = extent.grown(hull_margin(options, spacing));
    model.barriers = prepare_barriers(surfaces, extent, {}, spacing, options).barriers;
    for (Barrier& barrier : model.barriers) {
        const auto& p = barrier.margin.vertices;
        std::erase_if(barrier.margin.triangles, [&](const Triangle& t) {
            return distance(p[t[0]], p[t[1]]) < 0.01 * spacing && distance(p[t[0]], p[t[2]]) < 0.01 * spacing;
        });
    }
    return model;
}

/// Seeds, and other vertices as near to the faults as they may come: inserted ones.
void set_vertices(Model& model, const BarrierQuery& barriers) {
    model.vertices.clear();
    const auto add = [&](const Vec3& p, Role role, std::int32_t owner, std::int8_t side) {
        model.vertices.push_back({model.vertices.size(), p, role, owner, side});
    };
    for (std::size_t f = 0; f < model.barriers.size(); ++f) {
        for (const Seed& seed : model.barriers[f].seeds) {
            add(seed.position, Role::seed, static_cast<std::int32_t>(f), seed.side);
        }
    }
    testing::Random random(5);
    const Box3& hull = model.domain.hull;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 p{random(hull.lo.x, hull.hi.x), random(hull.lo.y, hull.hi.y), random(hull.lo.z, hull.hi.z)};
        if (barriers.protecting_barrier(p) < 0) {
            add(p, Role::inserted, -1, 0);
        }
    }
}

}  // namespace

TEST_CASE("F1: where edges slip through seeds, other vertices keep out until none does") {
    Model model = leaking_wedge();
    REQUIRE(model.barriers.size() == 2);
    std::size_t crossed = 0;
    std::vector<CrossingEdge> crossing;
    for (int round = 0; round < 8; ++round) {
        const BarrierQuery barriers(model.barriers);
        set_vertices(model, barriers);
        Tessellation tessellation;
        tessellation.insert(model.vertices);
        const TetMesh mesh = tessellation.mesh();
        crossing = fault_crossing_edges(model, mesh, barriers);
        crossed += crossing.size();
        if (crossing.empty()) {
            break;
        }
        CHECK(close_crossings(crossing, mesh, model));
        const BarrierQuery after(model.barriers);
        for (const CrossingEdge& edge : crossing) {
            for (const std::uint32_t v : {edge.a, edge.b}) {
                const Vertex& end = model.vertices[v];
                CHECK((end.role == Role::seed || after.protecting_barrier(end.position) >= 0));
            }
        }
    }
    CHECK(crossed > 0);
    CHECK(crossing.empty());
}

TEST_CASE("Edges between seeds are left as they are: keeping others away would not help") {
    Model model = leaking_wedge();
    set_vertices(model, BarrierQuery(model.barriers));
    const Model before = model;
    const auto mesh = [&] {
        Tessellation tessellation;
        tessellation.insert(model.vertices);
        return tessellation.mesh();
    }();
    const CrossingEdge between{0, 1, 1};
    CHECK_FALSE(close_crossings({&between, 1}, mesh, model));
    CHECK(model.barriers == before.barriers);
}

}  // namespace terratet
