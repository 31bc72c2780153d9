// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/barrier_edit.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/tess/fault_cases.hpp"

namespace terratet {
namespace {

struct World {
    Tessellation tessellation;
    VertexValues values;
};

const Box3 extent{{0, 0, 0}, {200, 200, 200}};
constexpr double spacing = 20;

ValueBatch field(std::span<const ValueQuery> queries) {
    ValueBatch batch;
    batch.values.resize(2);
    for (const ValueQuery& query : queries) {
        batch.values[0].push_back(query.position.x + 3 * query.side);
        batch.values[1].push_back(std::sin(query.position.y) * query.barrier);
        batch.extrapolation.push_back(0.001 * query.position.z);
    }
    return batch;
}

/// Samples and inserted vertices at random, every other time on a lattice: all ties. Ids with gaps, as after refining.
World random_world(testing::Random& random, bool lattice, const Box3& hull) {
    std::set<Vec3> places;
    for (int corner = 0; corner < 8; ++corner) {
        places.insert({(corner & 1) != 0 ? hull.hi.x : hull.lo.x, (corner & 2) != 0 ? hull.hi.y : hull.lo.y,
                       (corner & 4) != 0 ? hull.hi.z : hull.lo.z});
    }
    const std::size_t count = 50 + random.below(400);
    while (places.size() < count) {
        Vec3 p = random.in(extent);
        if (lattice) {
            p = {16 * std::floor(p.x / 16), 16 * std::floor(p.y / 16), 16 * std::floor(p.z / 16)};
        }
        places.insert(p);
    }
    std::vector<Vertex> vertices;
    std::vector<ValueQuery> queries;
    std::uint64_t id = random.below(5);
    for (const Vec3& p : places) {
        const bool on_hull = !extent.contains(p);
        const Role role = on_hull ? Role::domain : random.below(2) == 0 ? Role::sample : Role::inserted;
        vertices.push_back({id, p, role, role == Role::sample ? static_cast<std::int32_t>(id) : -1, 0});
        queries.push_back({p, -1, 0});
        id += 1 + random.below(3);
    }
    World world;
    world.tessellation.insert(vertices);
    ValueBatch batch = field(queries);
    world.values = {std::move(batch.values), std::move(batch.extrapolation)};
    return world;
}

void check_equal(const World& world, const World& before) {
    const auto now = world.tessellation.vertices();
    const auto then = before.tessellation.vertices();
    REQUIRE(std::vector<Vertex>(now.begin(), now.end()) == std::vector<Vertex>(then.begin(), then.end()));
    REQUIRE(world.values.values == before.values.values);
    REQUIRE(world.values.extrapolation == before.values.extrapolation);
    const TetMesh mesh = world.tessellation.mesh();
    const TetMesh expected = before.tessellation.mesh();
    REQUIRE(mesh.points == expected.points);
    REQUIRE(mesh.cells == expected.cells);
    REQUIRE(mesh.neighbours == expected.neighbours);
}

}  // namespace

TEST_CASE("F3: a fault in and out again is the identity, in 200 random cases") {
    testing::Random random(41);
    std::size_t removed = 0;
    for (int run = 0; run < 200; ++run) {
        INFO("run " << run);
        BarrierOptions options;
        options.mode = run % 3 == 0 ? SeedMode::exact : SeedMode::paired;
        std::vector<Surface> surfaces;
        for (std::uint64_t k = 0; k < 1 + random.below(2); ++k) {
            surfaces.push_back(testing::dipping("f" + std::to_string(k), random.in(extent.grown(-40)), random(0, 360),
                                                random(15, 90), random(20, 90), random(20, 90)));
        }
        const BarrierPreparation preparation = prepare_barriers(surfaces, extent, {}, spacing, options);
        const Domain domain{extent, extent.grown(hull_margin(options, spacing))};
        const std::uint64_t seed = random.below(1000000);
        testing::Random one(seed);
        testing::Random other(seed);
        const World before = random_world(one, run % 2 == 1, domain.hull);
        World world = random_world(other, run % 2 == 1, domain.hull);
        std::vector<BarrierChange> changes;
        for (std::size_t f = 0; f < preparation.barriers.size(); ++f) {
            changes.push_back(insert_barrier(world.tessellation, world.values, domain, preparation.barriers[f],
                                             static_cast<std::int32_t>(f), field));
            REQUIRE(changes.back().ids.size() > 4);
            removed += changes.back().removed.vertices.size();
        }
        REQUIRE(world.tessellation.is_delaunay());
        const BarrierQuery faults(preparation.barriers);
        for (std::size_t i = 0; i < world.tessellation.vertices().size(); ++i) {
            const Vertex& vertex = world.tessellation.vertices()[i];
            REQUIRE((vertex.role == Role::seed || vertex.role == Role::domain ||
                     faults.protecting_barrier(vertex.position) < 0));
            REQUIRE(world.values.values[0][i] == vertex.position.x + 3 * vertex.side);
        }
        if (run % 4 == 0) {
            std::ranges::reverse(changes);  // the first one out first: what they removed does not overlap
        }
        for (auto change = changes.rbegin(); change != changes.rend(); ++change) {
            take_out_barrier(world.tessellation, world.values, *change);
        }
        check_equal(world, before);
    }
    CHECK(removed > 5000);
}

}  // namespace terratet
