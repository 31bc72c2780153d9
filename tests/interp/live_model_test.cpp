// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/live_model.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <thread>

#include "interp/estimator_plan.hpp"
#include "tess/edit/given_values.hpp"
#include "tess/error.hpp"
#include "tess/mesh/quality.hpp"
#include "tess/site_edits.hpp"
#include "tess/value_source.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;

namespace {

testing::World faulted_world() {
    testing::World world = testing::random_world(5);
    world.site.surfaces = {testing::planar_fault("F", {150, 150, -100}, 0, 90, 500, 400, 15)};
    world.options.extent = {{0, 0, -200}, {300, 300, 0}};
    world.options.criteria = {};
    world.options.criteria.l_min = 15;
    world.options.criteria.l_max = 60;
    return world;
}

std::vector<ValueQuery> places() {
    std::vector<ValueQuery> queries;
    for (int i = 0; i < 50; ++i) {
        queries.push_back({{6.0 * i + 1, 290 - 5.0 * i, -4.0 * i - 1}});
    }
    return queries;
}

/// NaN equals itself here.
bool same(const std::vector<double>& a, const std::vector<double>& b) {
    return std::ranges::equal(a, b, [](double x, double y) { return x == y || (x != x && y != y); });
}

bool same_values(const ModelSnapshot& a, const ModelSnapshot& b) {
    const auto of_a = a.estimator().values(places());
    const auto of_b = b.estimator().values(places());
    return std::ranges::equal(of_a.values, of_b.values, same) && same(of_a.extrapolation, of_b.extrapolation);
}

}  // namespace

TEST_CASE("A live model that was built and one opened from what was stored are alike") {
    const testing::World world = faulted_world();
    const LiveModel built(world.site, world.options);
    const LiveModel opened(Model(built.model()));
    const auto a = built.snapshot();
    const auto b = opened.snapshot();
    CHECK(a->mesh().points == b->mesh().points);
    CHECK(a->mesh().cells == b->mesh().cells);
    CHECK(a->mesh().neighbours == b->mesh().neighbours);
    CHECK(a->cells().region == b->cells().region);
    CHECK(a->cells().barrier == b->cells().barrier);
    CHECK(a->cells().reason == b->cells().reason);
    CHECK(a->is_delaunay());
    CHECK(b->is_delaunay());
    CHECK(same_values(*a, *b));
    CHECK(a->collapsed(Collapsing::all).mesh.cells == b->collapsed(Collapsing::all).mesh.cells);
}

TEST_CASE("A model built without naming an estimator can be opened and asked") {
    const testing::World world = faulted_world();
    REQUIRE(world.options.estimator.empty());
    BuildReport report;
    const auto bare = build(world.site, world.options, testing::analytic_field(), report);
    const LiveModel opened{Model(bare->model)};
    CHECK(same_values(*opened.snapshot(), *LiveModel(world.site, world.options).snapshot()));
    CHECK(LiveModel(world.site, world.options).model().estimator.starts_with("natural"));
}

TEST_CASE("What follows from a model is made once, also when many threads ask first") {
    const testing::World world = faulted_world();
    const auto state = LiveModel(Model(LiveModel(world.site, world.options).model())).snapshot();
    std::vector<std::set<const void*>> seen(5);
    std::mutex mutex;
    std::vector<std::thread> readers;
    for (int t = 0; t < 4; ++t) {
        readers.emplace_back([&] {
            const std::array<const void*, 5> made{&state->cells(), &state->mesh(), &state->barriers(),
                                                  &state->estimator(), &state->collapsed(Collapsing::all)};
            const std::lock_guard lock(mutex);
            for (std::size_t i = 0; i < made.size(); ++i) {
                seen[i].insert(made[i]);
            }
        });
    }
    std::ranges::for_each(readers, &std::thread::join);
    for (const auto& one : seen) {
        CHECK(one.size() == 1);
    }
    CHECK(state->cells().region.size() == state->mesh().cells.size());
}

TEST_CASE("A snapshot stays as it is while its model loses a fault, and what the edit made is a model like any") {
    const testing::World world = faulted_world();
    LiveModel live(world.site, world.options);
    const auto before = live.snapshot();
    const auto cells = before->mesh().cells;
    REQUIRE(before->model().barriers.size() == 1);
    CHECK_THROWS_AS(live.remove_surface("G"), UsageError);
    CHECK(live.snapshot() == before);
    live.remove_surface("F");
    CHECK(live.model().barriers.empty());
    CHECK(before->model().barriers.size() == 1);
    CHECK(before->mesh().cells == cells);

    const LiveModel opened(Model(live.model()));
    CHECK(live.snapshot()->mesh().points == opened.snapshot()->mesh().points);
    CHECK(live.snapshot()->mesh().cells == opened.snapshot()->mesh().cells);
    CHECK(live.snapshot()->cells().region == opened.snapshot()->cells().region);
    CHECK(live.snapshot()->is_delaunay());
    CHECK(same_values(*live.snapshot(), *opened.snapshot()));
}

TEST_CASE("X1: a moved borehole leaves cells and values that are far from it as they are") {
    testing::World world = testing::random_world(5);
    world.site.surfaces.clear();
    world.options.extent = {{0, 0, -200}, {300, 300, 0}};
    world.options.criteria = {};
    world.options.criteria.l_min = 6;
    world.options.criteria.l_max = 24;
    world.options.estimator = "idw:max_points=8";
    LiveModel live(world.site, world.options);
    REQUIRE_FALSE(live.model().boreholes.empty());
    const auto before = live.snapshot();
    std::vector<Vec3> places;
    ModelPlan plan = plan_of(before->model());
    const auto note = [&] {
        for (std::size_t i = 0; i < plan.site.samples.size(); ++i) {
            if (plan.site.samples.borehole[i] == 0) {
                places.push_back(plan.site.samples.positions[i]);
            }
        }
    };
    note();
    move_borehole(plan.site, before->model().boreholes.front().id, {3, -2, 1});
    note();
    live.edit(plan);
    const auto after = live.snapshot();
    std::map<Vec3, double> value_after;
    for (std::size_t v = 0; v < after->model().vertices.size(); ++v) {
        value_after[after->model().vertices[v].position] = after->model().vertex_values.values[1][v];
    }
    std::set<std::set<Vec3>> cells_after;
    const auto corners = [](const TetMesh& mesh, std::size_t c) {
        std::set<Vec3> places_of_cell;
        for (const std::uint32_t v : mesh.cells[c]) {
            places_of_cell.insert(mesh.points[v]);
        }
        return places_of_cell;
    };
    for (std::size_t c = 0; c < after->mesh().cells.size(); ++c) {
        cells_after.insert(corners(after->mesh(), c));
    }
    std::size_t far = 0;
    for (std::size_t c = 0; c < before->mesh().cells.size(); ++c) {
        const Circumsphere sphere = circumsphere(cell_points(before->mesh(), before->mesh().cells[c]));
        const double reach = std::sqrt(sphere.squared_radius) + 3 * 24;
        if (std::ranges::all_of(places, [&](const Vec3& p) { return distance(p, sphere.center) > reach; })) {
            ++far;
            CHECK(cells_after.contains(corners(before->mesh(), c)));
        }
    }
    CHECK(far > 100);
    std::size_t same = 0;
    for (std::size_t v = 0; v < before->model().vertices.size(); ++v) {
        const auto found = value_after.find(before->model().vertices[v].position);
        same += found != value_after.end() && found->second == before->model().vertex_values.values[1][v] ? 1 : 0;
    }
    CHECK(same > far / 10);
}

namespace {

/// Holes on a shaken square, samples each 8 m; the second property is measured in some of them only.
Site field_of_holes(int across) {
    testing::Random random(3);
    Site site;
    site.properties = {{"f", "", Scale::linear, Kind::continuous, {}}, {"g", "", Scale::log10, Kind::continuous, {}}};
    site.samples.values.resize(2);
    for (int w = 0; w < across * across; ++w) {
        const Vec3 collar = site.frame.snapped(
            {60 * (w % across + random(0.2, 0.8)), 60 * (w / across + random(0.2, 0.8)), random(-5, 0)});
        const Vec3 lean{random(-0.1, 0.1), random(-0.1, 0.1), -1};
        Borehole hole{"W" + std::to_string(1000 + w), collar, {collar, collar + 120 * lean}, {0, 120}};
        for (int i = 0; i < 15; ++i) {
            const Vec3 p = site.frame.snapped(collar + (8 * i + 4) * lean);
            site.samples.positions.push_back(p);
            site.samples.borehole.push_back(w);
            site.samples.depth.push_back(8 * i + 4);
            site.samples.length.push_back(0);
            site.samples.values[0].push_back(std::sin(p.x / 50) + p.z / 30 + random(-0.1, 0.1));
            site.samples.values[1].push_back(w % 3 == 0 ? missing : std::pow(10, random(-8, -6)));
        }
        site.boreholes.push_back(std::move(hole));
    }
    return site;
}

/// Of vertices, by an estimator made for the model as it is.
std::size_t values_that_differ(const Model& model) {
    const BarrierQuery barriers = model_proximity(model);
    const ModelEstimator anew(model, barriers, parse_estimator_plan(model.estimator));
    const VertexValues values =
        measured_or_estimated(model, [&](std::span<const ValueQuery> queries) { return anew.values(queries); });
    std::size_t differ = 0;
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
        bool equal = values.extrapolation[v] == model.vertex_values.extrapolation[v];
        for (std::size_t p = 0; p < values.values.size(); ++p) {
            const double a = values.values[p][v], b = model.vertex_values.values[p][v];
            equal = equal && (a == b || (a != a && b != b));
        }
        differ += equal ? 0 : 1;
    }
    return differ;
}

}  // namespace

TEST_CASE(
    "X1: edits estimate anew where samples tell something else, and all values are a new estimation's to the bit") {
    for (const std::string name : {"natural", "linear:ratio3=0.5"}) {
        for (const bool faulted : {false, true}) {
            INFO(name << (faulted ? ", a fault" : ""));
            Site site = field_of_holes(faulted ? 6 : 7);
            if (faulted) {
                site.surfaces = {testing::planar_fault("F", site.frame.snapped({180, 170, -60}), 20, 75, 90, 60, 20)};
            }
            BuildOptions options;
            options.estimator = name;
            options.criteria.l_min = 10;
            options.criteria.l_max = 40;
            LiveModel live(std::move(site), options);
            REQUIRE(values_that_differ(live.model()) == 0);
            testing::Random random(9);
            const auto holes = live.model().boreholes.size();
            for (int edit = 0; edit < 4; ++edit) {
                ModelPlan plan = plan_of(live.model());
                const std::string id = "W" + std::to_string(1000 + random.below(holes));
                switch (edit % 4) {
                    case 2: {  // other values at places that stay, and some that leave
                        std::vector<bool> marked(plan.site.samples.size(), false);
                        for (std::size_t i = 0; i < 5; ++i) {
                            const std::size_t sample = random.below(marked.size());
                            plan.site.samples.values[0][sample] += 0.3;
                            marked[random.below(marked.size())] = true;
                        }
                        remove_samples(plan.site, marked);
                        break;
                    }
                    case 3:
                        plan.criteria.overrides.push_back(
                            {ResolutionOverride::Where::box, {{50, 50, -90}, {110.0 + edit, 100, -30}}, {}, 5, 20});
                        break;
                    default:
                        move_borehole(plan.site, id, plan.site.frame.snapped({random(-8, 8), random(-8, 8), 0}));
                }
                live.edit(std::move(plan));
                CHECK(values_that_differ(live.model()) == 0);
            }
        }
    }
}

TEST_CASE("A hole moved among many changes few estimates, and which those are is known") {
    const Site site = field_of_holes(14);
    BuildOptions options;
    options.criteria.l_min = 20;
    options.criteria.l_max = 80;
    options.estimator = "natural:anisotropy=none";
    LiveModel live(site, options);
    const auto before = live.snapshot();
    ModelPlan plan = plan_of(live.model());
    move_borehole(plan.site, "W1106", plan.site.frame.snapped({5, -4, 0}));
    live.edit(std::move(plan));
    const Model& model = before->model();
    const Model& after = live.model();
    REQUIRE(before->source_of_values() != nullptr);
    const BarrierQuery barriers = model_proximity(after);
    const ModelEstimator anew(after, barriers, parse_estimator_plan(after.estimator));
    std::vector<std::int64_t> same(after.samples.size());
    for (std::size_t i = 0; i < same.size(); ++i) {
        same[i] = after.samples.positions[i] == model.samples.positions[i] ? static_cast<std::int64_t>(i) : -1;
    }
    std::vector<ValueQuery> queries;
    for (const Vertex& vertex : model.vertices) {
        queries.push_back(query_of(vertex));
    }
    const auto differs =
        anew.changes_since(*before->source_of_values(), same)->at(queries, model.vertex_values.extrapolation);
    const auto told = static_cast<std::size_t>(std::ranges::count(differs, 1));
    const ValueBatch was = before->source_of_values()->values(queries);
    const ValueBatch is = anew.values(queries);
    std::size_t differ = 0, missed = 0;
    for (std::size_t v = 0; v < queries.size(); ++v) {
        const bool other = was.values[0][v] != is.values[0][v];
        differ += other ? 1 : 0;
        missed += other && differs[v] == 0 ? 1 : 0;
    }
    CHECK(differ > 0);
    CHECK(missed == 0);
    CHECK(told < queries.size() / 3);
}

TEST_CASE("Uncertainty becomes properties of the model, and none of a snapshot that somebody holds") {
    const testing::World world = faulted_world();
    LiveModel live(world.site, world.options);
    const auto held = live.snapshot();
    const std::size_t properties = held->model().properties.size();
    live.add_uncertainty();
    CHECK(held->model().properties.size() == properties);
    CHECK(live.model().properties.size() > properties);
    CHECK(live.model().vertex_values.values.size() == live.model().properties.size());
    CHECK(live.model().estimator.find("uncertainty:") != std::string::npos);
    CHECK(live.snapshot()->mesh().cells == held->mesh().cells);

    LiveModel alone(world.site, world.options);
    alone.add_uncertainty();
    CHECK(alone.model().vertex_values.values.size() == live.model().vertex_values.values.size());
    for (std::size_t p = 0; p < alone.model().vertex_values.values.size(); ++p) {
        CHECK(same(alone.model().vertex_values.values[p], live.model().vertex_values.values[p]));
    }
}

TEST_CASE("A borehole's neighbours are those that an edge leads to") {
    testing::World world = testing::random_world(5);
    const LiveModel live(world.site, world.options);
    const Model& model = live.model();
    REQUIRE_FALSE(model.boreholes.empty());
    CHECK_THROWS_AS(live.neighbours_of("none of that name"), UsageError);
    const auto is_own = [&](std::uint32_t v) {
        return model.vertices[v].role == Role::sample &&
               model.samples.borehole[static_cast<std::size_t>(model.vertices[v].owner)] == 0;
    };
    std::set<std::uint32_t> expected;
    for (const auto& cell : live.snapshot()->mesh().cells) {
        for (const std::uint32_t a : cell) {
            for (const std::uint32_t b : cell) {
                if (is_own(a) && !is_own(b)) {
                    expected.insert(b);
                }
            }
        }
    }
    const auto found = live.neighbours_of(model.boreholes.front().id);
    CHECK(!found.empty());
    CHECK(std::set(found.begin(), found.end()) == expected);
    CHECK(std::ranges::is_sorted(found));
}
