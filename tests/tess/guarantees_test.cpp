// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

#include "tess/cells.hpp"
#include "tess/mesh/quality.hpp"
#include "tess/model/resolution.hpp"
#include "tess/refine/refine.hpp"
#include "tess/verify.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;
using testing::build_world;
using testing::random_world;

namespace {

constexpr std::uint64_t world_count = 500;

constexpr std::array<std::array<std::size_t, 2>, 6> cell_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

bool touch(const Box3& a, const Box3& b) {
    return std::ranges::all_of(std::array{0, 1, 2},
                               [&](int axis) { return a.lo[axis] <= b.hi[axis] && b.lo[axis] <= a.hi[axis]; });
}

/// A built world with its flat mesh, for oracles that know nothing of how it was made.
struct Case {
    testing::World world;
    Model model;
    BuildReport report;
    TetMesh mesh;
    CellTable table;

    [[nodiscard]] CellPoints corners(std::size_t c) const {
        const auto& v = mesh.cells[c];
        return {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]], mesh.points[v[3]]};
    }

    /// l_min at a place: the last box that holds it counts.
    [[nodiscard]] double l_min(const Vec3& p) const {
        double result = model.criteria.l_min;
        for (const ResolutionOverride& part : model.criteria.overrides) {
            result = part.box.contains(p) ? part.l_min : result;
        }
        return result;
    }

    /// The largest l_max a cell may be judged by: that of the finest box that it touches.
    [[nodiscard]] double l_max(std::size_t cell) const {
        const Box3 box = bounding_box(corners(cell));
        double result = model.criteria.l_max;
        for (const ResolutionOverride& part : model.criteria.overrides) {
            const bool within = part.box.contains(box.lo) && part.box.contains(box.hi);
            result = within ? part.l_max : touch(part.box, box) ? std::min(result, part.l_max) : result;
        }
        return result;
    }
};

Case build_case(std::uint64_t seed) {
    Case c;
    c.world = random_world(seed);
    INFO(c.world.description);
    auto built = build_world(c.world);
    c.model = std::move(built.model);
    c.report = std::move(built.report);
    c.mesh = tessellate(c.model).mesh();
    c.table = describe_cells(c.model, c.mesh);
    return c;
}

/// Built once: all test cases look at the same worlds.
const std::vector<Case>& cases() {
    static const std::vector<Case> all = [] {
        std::vector<Case> built;
        for (std::uint64_t seed = 0; seed < world_count; ++seed) {
            built.push_back(build_case(seed));
        }
        return built;
    }();
    return all;
}

template <class Check>
void for_each_world(const Check& check, std::uint64_t count = world_count) {
    for (const Case& c : std::span(cases()).first(count)) {
        INFO(c.world.description);
        check(c);
    }
}

/// The largest |Δf| over its limit along an edge, edges across a fault left out.
double worst_variation(const Case& c, const BarrierQuery& proximity, std::size_t cell) {
    double worst = 0;
    for (std::size_t p = 0; p < c.model.criteria.variation.size(); ++p) {
        const double limit = c.model.criteria.variation[p].df_max;
        for (const auto& [i, j] : cell_edges) {
            const auto a = c.mesh.cells[cell][i];
            const auto b = c.mesh.cells[cell][j];
            const auto& column = c.model.vertex_values.values[p];
            if (limit > 0 && !proximity.crosses_any(c.mesh.points[a], c.mesh.points[b])) {
                worst = std::max(worst, scaled_difference(c.model.properties[p], column[a], column[b]) / limit);
            }
        }
    }
    return worst;
}

bool is_good(const Case& c, const BarrierQuery& proximity, std::size_t cell) {
    const Criteria& limits = c.model.criteria;
    const CellQuality q = cell_quality(c.corners(cell));
    constexpr double slack = 1 + 1e-9;
    return q.longest_edge <= c.l_max(cell) * slack &&
           (limits.radius_edge == 0 || q.radius_edge <= limits.radius_edge * slack) &&
           (limits.aspect == 0 || q.aspect <= limits.aspect * slack) &&
           (limits.v_max == 0 || q.volume <= limits.v_max * slack) && worst_variation(c, proximity, cell) <= slack;
}

CGAL::Epick::Point_3 exact(const Vec3& p) {
    return {p.x, p.y, p.z};
}

}  // namespace

TEST_CASE("R1: inserted vertices never exceed the packing bound, and refinement terminates") {
    for_each_world([](const Case& c) {
        REQUIRE(static_cast<double>(c.report.refine.inserted) <= c.report.refine.bound);
        double bound = packing_bound(c.model.domain.hull, c.model.criteria.l_min);
        for (const ResolutionOverride& part : c.model.criteria.overrides) {
            bound += packing_bound({c.model.domain.hull.clamped(part.box.lo), c.model.domain.hull.clamped(part.box.hi)},
                                   part.l_min);
        }
        REQUIRE(c.report.refine.bound == bound);
        REQUIRE(static_cast<std::uint64_t>(std::ranges::count(c.model.vertices, Role::inserted, &Vertex::role)) ==
                c.report.refine.inserted - c.report.refine.removed);
    });
}

TEST_CASE("R2: each cell outside the gaps meets every insertion criterion or carries a reason code") {
    std::size_t excused = 0;
    for_each_world([&](const Case& c) {
        const BarrierQuery proximity = model_proximity(c.model);
        for (std::size_t cell = 0; cell < c.mesh.cells.size(); ++cell) {
            if (c.table.barrier[cell] >= 0) {
                continue;
            }
            const bool good = is_good(c, proximity, cell);
            const Reason reason = c.table.reason[cell];
            excused += good ? 0 : 1;
            REQUIRE((good || reason != Reason::none));
            if (reason == Reason::too_close) {
                const Vec3 centre = circumsphere(c.corners(cell)).center;
                const double l_min = std::max(c.l_min(centre), c.l_min(c.model.domain.hull.clamped(centre)));
                REQUIRE(cell_quality(c.corners(cell)).circumradius < l_min + 1e-6);
            }
        }
    });
    CHECK(excused > 0);
}

TEST_CASE("R3: no inserted vertex is nearer than l_min to any other vertex") {
    for_each_world([](const Case& c) {
        for (const Vertex& a : c.model.vertices) {
            if (a.role != Role::inserted) {
                continue;
            }
            for (const Vertex& b : c.model.vertices) {
                const double l_min =
                    b.role == Role::inserted ? std::min(c.l_min(a.position), c.l_min(b.position)) : c.l_min(a.position);
                if (a.id != b.id && distance(a.position, b.position) < l_min) {
                    FAIL("vertices " << a.id << " and " << b.id << " are " << distance(a.position, b.position)
                                     << " apart");
                }
            }
        }
    });
}

TEST_CASE("R4: with l_max at least 4 l_min no edge exceeds l_max but near faults and in smooth cells") {
    int promised = 0;
    for_each_world([&](const Case& c) {
        const BarrierQuery proximity = model_proximity(c.model);
        for (std::size_t cell = 0; cell < c.mesh.cells.size(); ++cell) {
            const Circumsphere sphere = circumsphere(c.corners(cell));
            if (c.table.barrier[cell] < 0 && c.table.reason[cell] != Reason::smooth &&
                c.model.domain.extent.contains(sphere.center) && proximity.protecting_barrier(sphere.center) < 0 &&
                c.l_max(cell) >= 4 * c.l_min(sphere.center)) {
                ++promised;
                REQUIRE(cell_quality(c.corners(cell)).longest_edge <= c.l_max(cell) * (1 + 1e-9));
            }
        }
    });
    CHECK(promised > 10000);
}

TEST_CASE("R5: the tessellation is Delaunay, by brute force over all cells and vertices") {
    for_each_world(
        [](const Case& c) {
            REQUIRE(tessellate(c.model).is_delaunay());
            if (c.model.vertices.size() > 600) {
                return;
            }
            for (std::size_t cell = 0; cell < c.mesh.cells.size(); ++cell) {
                const CellPoints corners = c.corners(cell);
                const Circumsphere sphere = circumsphere(corners);
                for (const Vec3& p : c.mesh.points) {
                    if (squared_distance(p, sphere.center) > sphere.squared_radius * (1 + 1e-3)) {
                        continue;  // clearly outside; the exact predicate decides the rest
                    }
                    REQUIRE(CGAL::side_of_bounded_sphere(exact(corners[0]), exact(corners[1]), exact(corners[2]),
                                                         exact(corners[3]), exact(p)) != CGAL::ON_BOUNDED_SIDE);
                }
            }
        },
        60);
}

TEST_CASE("R6: the result does not depend on the order of rows") {
    testing::Random random(6);
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        testing::World world = random_world(seed);
        INFO(world.description);
        const Model first = build_world(world).model;
        std::vector<std::uint32_t> order(world.site.samples.size());
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        for (std::size_t i = order.size(); i > 1; --i) {
            std::swap(order[i - 1], order[random.below(i)]);
        }
        world.site.samples = selected(world.site.samples, order);
        std::ranges::reverse(world.site.surfaces);
        const Model second = build_world(world).model;
        REQUIRE(first.vertices == second.vertices);
        REQUIRE(first.vertex_values.values.size() == second.vertex_values.values.size());
        REQUIRE(tessellate(first).mesh().cells == tessellate(second).mesh().cells);
    }
}

TEST_CASE("R7: refining a finished model again inserts, moves and removes nothing") {
    for_each_world([](const Case& c) {
        Tessellation again = tessellate(c.model);
        VertexValues values = c.model.vertex_values;
        const BarrierQuery proximity = model_proximity(c.model);
        const auto report = refine(again, values, c.model.domain, c.model.frame, proximity, c.model.criteria,
                                   c.model.properties, testing::analytic_field()(c.model, proximity));
        REQUIRE(report.inserted + report.moved + report.removed == 0);
    });
}

TEST_CASE("F1: no edge crosses a fault but between its seeds, in whole models") {
    std::size_t faults = 0;
    for_each_world([&](const Case& c) {
        faults += c.model.barriers.size();
        REQUIRE(c.report.fault_crossing_edges == 0);
    });
    CHECK(faults > 50);
}

TEST_CASE("V1: kept samples carry their measured values") {
    for_each_world([](const Case& c) {
        for (std::size_t i = 0; i < c.model.vertices.size(); ++i) {
            const Vertex& v = c.model.vertices[i];
            for (std::size_t p = 0; v.role == Role::sample && p < c.model.properties.size(); ++p) {
                const double measured = c.model.samples.values[p][static_cast<std::size_t>(v.owner)];
                REQUIRE((std::isnan(measured) || c.model.vertex_values.values[p][i] == measured));
                REQUIRE(c.model.samples.positions[static_cast<std::size_t>(v.owner)] == v.position);
            }
        }
    });
}

TEST_CASE("The cells fill the hull box, and every vertex has its values") {
    for_each_world([](const Case& c) {
        double volume = 0;
        for (std::size_t cell = 0; cell < c.mesh.cells.size(); ++cell) {
            volume += cell_quality(c.corners(cell)).volume;
        }
        REQUIRE(volume == Approx(c.model.domain.hull.volume()).epsilon(1e-9));
        REQUIRE(c.model.vertex_values.extrapolation.size() == c.model.vertices.size());
        REQUIRE(c.model.vertex_values.values[0].size() == c.model.vertices.size());
    });
}

TEST_CASE("Verification agrees that every guarantee holds") {
    for_each_world(
        [](const Case& c) {
            for (const Verdict& verdict : verify(c.model, testing::analytic_field())) {
                INFO(verdict.guarantee << ": " << verdict.detail);
                REQUIRE(verdict.holds);
            }
        },
        60);
}
