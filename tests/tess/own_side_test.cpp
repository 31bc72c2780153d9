// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tess/barrier/query/own_side.hpp"
#include "tess/cells.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 point(const Vec3& p) {
    return {p.x, p.y, p.z};
}

/// By CGAL's exact predicates, triangle by triangle.
bool parted(const std::vector<Barrier>& faults, const Vec3& a, const Vec3& b) {
    const Kernel::Segment_3 way(point(a), point(b));
    for (const Barrier& fault : faults) {
        for (const Triangle& t : fault.sheet.triangles) {
            const auto& v = fault.sheet.vertices;
            if (fault.sheet.kind == SurfaceKind::fault &&
                CGAL::do_intersect(way, Kernel::Triangle_3(point(v[t[0]]), point(v[t[1]]), point(v[t[2]])))) {
                return true;
            }
        }
    }
    return false;
}

/// Between seeds of several faults?
bool at_junction(const Model& model, const std::array<std::uint32_t, 4>& cell) {
    return std::ranges::any_of(
        cell, [&](std::uint32_t v) { return model.vertices[v].owner != model.vertices[cell[0]].owner; });
}

}  // namespace

TEST_CASE("E1: in gap cells, those where faults meet included, a value is of vertices on its own side alone") {
    std::size_t at_junctions = 0;
    std::size_t mixed_before = 0;
    for (const std::uint64_t seed : {2, 12, 22, 32}) {
        const Model model = testing::build_world(testing::random_world(seed)).model;
        INFO("world " << seed);
        REQUIRE(model.barriers.size() == 2);
        const TetMesh mesh = tessellate(model).mesh();
        const CellTable table = describe_cells(model, mesh);
        const BarrierQuery proximity(model.barriers);
        const OwnSide sides(mesh, table.barrier, proximity);
        testing::Random random(seed);
        std::size_t without = 0;
        std::size_t tried = 0;
        std::size_t budget = 150;
        for (std::uint32_t c = 0; c < mesh.cells.size(); ++c) {
            REQUIRE(sides.concerns(c) == (table.barrier[c] >= 0));
            const bool junction = sides.concerns(c) && at_junction(model, mesh.cells[c]);
            if (!sides.concerns(c) || (!junction && random.below(200) != 0) || (junction && budget == 0)) {
                continue;
            }
            budget -= junction ? 1 : 0;
            std::array<double, 4> weights{};
            double sum = 0;
            for (double& w : weights) {
                w = -std::log(1 - random());
                sum += w;
            }
            Vec3 p;
            for (std::size_t k = 0; k < 4; ++k) {
                weights[k] /= sum;
                p = p + weights[k] * mesh.points[mesh.cells[c][k]];
            }
            const VertexWeights own = sides.weights(c, p, weights);
            ++tried;
            at_junctions += junction ? 1 : 0;
            if (std::isnan(own.weights[0])) {
                ++without;
                continue;
            }
            double total = 0;
            for (std::size_t k = 0; k < 4; ++k) {
                REQUIRE(own.weights[k] >= 0);
                total += own.weights[k];
                if (own.weights[k] > 0) {
                    REQUIRE_FALSE(parted(model.barriers, p, mesh.points[own.vertices[k]]));
                }
                mixed_before += junction && parted(model.barriers, p, mesh.points[mesh.cells[c][k]]) ? 1 : 0;
            }
            REQUIRE(total == Approx(1));
        }
        CHECK(tried > 100);
        CHECK(without == 0);
    }
    CHECK(at_junctions > 200);
    CHECK(mixed_before > 100);  // or nothing was at stake
}
