// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/change_model.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <tuple>

#include "tess/error.hpp"
#include "tess/mesh/quality.hpp"
#include "tess/site_edits.hpp"
#include "tess/verify.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;

namespace {

/// A model that goes through edits, its tessellation kept up.
struct Edited {
    Model model;
    Tessellation tessellation;
    ChangeReport report;

    explicit Edited(Model built) : model(std::move(built)), tessellation(tessellate(model)) {}

    void apply(ModelPlan plan) {
        report = {};
        const auto factory = [](const Model& of, const BarrierQuery& barriers, bool, bool) -> NextValues {
            return testing::analytic_field()(of, barriers);
        };
        auto changed = change_model(model, std::move(tessellation), std::move(plan), factory, report);
        model = std::move(changed->model);
        tessellation = std::move(*changed->tessellation);
    }
};

/// What the edit is about, and how far it may reach.
struct Geometry {
    std::vector<Vec3> places;

    [[nodiscard]] double distance_to(const Vec3& p) const {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Vec3& q : places) {
            nearest = std::min(nearest, distance(p, q));
        }
        return nearest;
    }
};

void add_hole(const Site& site, std::int32_t hole, Geometry& geometry) {
    for (std::size_t i = 0; i < site.samples.size(); ++i) {
        if (site.samples.borehole[i] == hole) {
            geometry.places.push_back(site.samples.positions[i]);
        }
    }
}

/// A random edit of any kind.
ModelPlan random_plan(const Model& model, testing::Random& random, Geometry& geometry, std::string& what) {
    ModelPlan plan = plan_of(model);
    const std::uint64_t kind = random.below(40);  // what has faults prepared takes longest: seldom
    const auto holes = static_cast<std::int32_t>(model.boreholes.size());
    if (kind < 19 && holes > 0) {
        const auto hole = static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(holes)));
        const std::string id = model.boreholes[static_cast<std::size_t>(hole)].id;
        add_hole(plan.site, hole, geometry);
        what = "move " + id;
        move_borehole(plan.site, id, random.in({{-20, -20, -5}, {20, 20, 5}}));
        add_hole(plan.site, hole, geometry);
    } else if (kind < 23 && holes > 2) {
        const auto hole = static_cast<std::int32_t>(random.below(static_cast<std::uint64_t>(holes)));
        add_hole(plan.site, hole, geometry);
        what = "remove a hole";
        remove_borehole(plan.site, model.boreholes[static_cast<std::size_t>(hole)].id);
    } else if (kind < 29) {
        Site added;
        added.frame = model.frame;
        added.properties = model.properties;
        added.samples.values.resize(2);
        const Vec3 at = random.in({{20, 20, -150}, {280, 280, 0}});
        added.boreholes.push_back({"N" + std::to_string(random.below(1'000'000'000)), at, {at}, {0}});
        const bool loose = random() < 0.3;
        if (loose) {
            added.boreholes.clear();
        }
        for (int i = 0; i < 15; ++i) {
            added.samples.positions.push_back(model.frame.snapped(at - Vec3{0, 0, 4.0 * i}));
            added.samples.borehole.push_back(loose ? -1 : 0);
            added.samples.depth.push_back(loose ? missing : 4.0 * i);
            added.samples.length.push_back(0);
            added.samples.values[0].push_back(1);
            added.samples.values[1].push_back(1e-9);
        }
        geometry.places = added.samples.positions;
        what = loose ? "add samples" : "add a hole";
        CHECK(add_site(plan.site, added).empty());
    } else if (kind < 34) {
        std::vector<bool> marked(model.samples.size());
        for (std::size_t i = 0; i < marked.size(); ++i) {
            marked[i] = random() < 0.02 && model.samples.size() > 20;
            if (marked[i]) {
                geometry.places.push_back(model.samples.positions[i]);
            }
        }
        what = "remove samples";
        remove_samples(plan.site, marked);
    } else if (kind == 34 && !plan.site.surfaces.empty()) {
        Surface surface = plan.site.surfaces[random.below(plan.site.surfaces.size())];
        remove_surface(plan.site, surface.name);
        for (const Barrier& barrier : model.barriers) {  // what it meets is prepared again
            geometry.places.insert(geometry.places.end(), barrier.sheet.vertices.begin(), barrier.sheet.vertices.end());
            geometry.places.insert(geometry.places.end(), barrier.margin.vertices.begin(),
                                   barrier.margin.vertices.end());
        }
        what = "remove " + surface.name;
        if (random() < 0.5) {
            for (Vec3& p : surface.vertices) {
                p = p + Vec3{7, 0, 0};
                geometry.places.push_back(p);
            }
            what = "replace " + surface.name;
            plan.site.surfaces.push_back(surface);
        }
    } else if (kind == 35 && model.surfaces.size() < 3) {
        plan.site.surfaces.push_back(testing::planar_fault(
            "G" + std::to_string(random.below(1'000'000'000)), random.in({{80, 80, -150}, {220, 220, -50}}),
            random(0, 360), random(20, 90), random(40, 90), random(40, 80), model.criteria.l_min));
        what = "add a fault";
    } else {
        auto& parts = plan.criteria.overrides;
        if (!parts.empty() && (random() < 0.5 || parts.size() > 5)) {
            parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(random.below(parts.size())));
        }
        const Vec3 corner = random.in({{0, 0, -200}, {200, 200, -100}});
        const double l_min = random(0.6, 1.5) * model.criteria.l_min;
        parts.push_back({ResolutionOverride::Where::box,
                         {corner, corner + random.in({{20, 20, 20}, {80, 80, 80}})},
                         {},
                         l_min,
                         l_min * random(1.5, 6)});
        what = "set a resolution";
    }
    return plan;
}

void check_guarantees(const Model& model, const std::string& history) {
    for (const Verdict& verdict : verify(model, testing::analytic_field(), {}, true)) {
        INFO(history << ": " << verdict.guarantee << ' ' << verdict.statement << ' ' << verdict.detail);
        CHECK(verdict.holds);
    }
}

/// The tessellation kept up against one of the stored vertices, cell for cell.
void check_same_cells(const Edited& edited) {
    const TetMesh kept = edited.tessellation.mesh();
    const TetMesh fresh = tessellate(edited.model).mesh();
    CHECK(kept.points == fresh.points);
    CHECK(kept.cells == fresh.cells);
    CHECK(kept.neighbours == fresh.neighbours);
    CHECK(std::ranges::equal(edited.tessellation.vertices(), edited.model.vertices));
}

std::uint64_t asked_for(const char* variable, std::uint64_t otherwise) {
    const char* const asked = std::getenv(variable);
    return asked != nullptr ? std::strtoull(asked, nullptr, 10) : otherwise;
}

/// One after the other; all is verified each `often` edits and at the end.
void edit_at_random(Edited& edited, std::uint64_t count, std::uint64_t often, testing::Random& random,
                    std::string history) {
    for (std::uint64_t e = 0; e < count; ++e) {
        Geometry geometry;
        std::string what;
        ModelPlan plan = random_plan(edited.model, random, geometry, what);
        history += ", " + what;
        edited.apply(std::move(plan));
        if (e % often == often - 1 || e + 1 == count) {
            INFO(history);
            check_same_cells(edited);
            check_guarantees(edited.model, history);
        }
    }
}

/// Some ten thousand vertices, three faults, two of which meet.
testing::World large_world() {
    testing::World world = testing::random_world(100);
    world.site.surfaces.clear();
    for (const auto& [name, x, strike] : {std::tuple("A", 110.0, 20.0), {"B", 130.0, 110.0}, {"C", 240.0, 30.0}}) {
        world.site.surfaces.push_back(testing::planar_fault(name, {x, 150, -100}, strike, 70, 50, 40, 12));
    }
    world.options.criteria.l_min = 12;
    world.options.criteria.l_max = 34;
    return world;
}

}  // namespace

TEST_CASE(
    "X3: random edits leave the tessellation of the stored vertices, and every guarantee that is asked of an edited "
    "model") {
    testing::Random random(asked_for("TERRATET_EDIT_SEED", 99));
    const std::uint64_t worlds = 30;
    const std::uint64_t each = asked_for("TERRATET_EDITS", 900) / worlds;
    for (std::uint64_t w = 0; w < worlds; ++w) {
        testing::World world = testing::random_world(100 + w);
        if (world.site.samples.size() < 30) {
            continue;
        }
        world.options.extent = {{0, 0, -200}, {300, 300, 0}};
        std::optional<Edited> edited;
        edited.emplace(std::move(testing::build_world(world).model));
        edit_at_random(*edited, each, 1000, random, world.description);
    }
}

TEST_CASE("X3: many random edits of one model of ten thousand vertices whose faults meet", "[.large]") {
    testing::Random random(asked_for("TERRATET_EDIT_SEED", 99));
    testing::World world = large_world();
    world.options.extent = {{0, 0, -200}, {300, 300, 0}};
    Edited edited(std::move(testing::build_world(world).model));
    WARN(edited.model.vertices.size() << " vertices, " << edited.model.barriers.size() << " faults");
    edit_at_random(edited, asked_for("TERRATET_EDITS", 1000), 1000, random, "large");
}
