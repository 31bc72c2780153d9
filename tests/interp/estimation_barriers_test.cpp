// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/query/estimation_barriers.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "estimation.hpp"
#include "interp/estimator_spec.hpp"
#include "interp/lattice.hpp"
#include "interp/model_estimator.hpp"
#include "interp/plan/model_source.hpp"
#include "interp/voxels/resample.hpp"
#include "tess/barrier/query/own_side.hpp"
#include "tess/barrier_query.hpp"
#include "tess/build.hpp"
#include "tess/property.hpp"
#include "tess/value_source.hpp"

using namespace terratet;
using namespace terratet::testing;

namespace {

/// A grid of n × m quadrilaterals over the unit square, put somewhere.
Surface sheet(const std::string& name, int n, int m, const std::function<Vec3(double, double)>& place) {
    Surface surface;
    surface.name = name;
    const auto stride = static_cast<std::uint32_t>(m + 1);
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= m; ++j) {
            surface.vertices.push_back(place(double(i) / n, double(j) / m));
        }
    }
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
        for (std::uint32_t j = 0; j + 1 < stride; ++j) {
            const std::uint32_t a = i * stride + j;
            surface.triangles.push_back({a, a + stride, a + stride + 1});
            surface.triangles.push_back({a, a + stride + 1, a + 1});
        }
    }
    return surface;
}

/// What is to be on which side of the faults, and where that is not for them to say: too close to a bent one.
struct Sides {
    std::vector<Surface> faults;
    std::function<double(const Vec3&)> value;
    std::function<double(const Vec3&)> distance = [](const Vec3&) { return 1.0; };
    double unsure = 0;
    Box3 samples{{0, 0, 0}, {1000, 1000, 600}};
    Box3 extent{};  ///< empty: the default
    std::size_t count = 300;
};

Model built(const Sides& sides, BuildReport& report) {
    Site site;
    site.properties = {{"side", "", Scale::linear, Kind::continuous, {}}};
    site.samples.values.resize(1);
    Random random(7);
    while (site.samples.positions.size() < sides.count) {
        const Vec3 p = random.in(sides.samples);
        if (std::abs(sides.distance(p)) > sides.unsure) {
            site.samples.positions.push_back(p);
            site.samples.borehole.push_back(-1);
            site.samples.depth.push_back(missing);
            site.samples.length.push_back(0);
            site.samples.values[0].push_back(sides.value(p));
        }
    }
    site.surfaces = sides.faults;
    BuildOptions options;
    options.extent = sides.extent;
    options.criteria.l_min = 60;
    options.criteria.l_max = 240;
    const auto source = [](const Model& model, const BarrierQuery& faults) {
        return make_model_source(model, faults, {});
    };
    return std::move(build(std::move(site), options, source, report)->model);
}

/// Of values at places: how many are none of the sides' own, and how many are another side's.
struct Wrong {
    std::size_t mixed = 0;
    std::size_t across = 0;
    std::size_t none = 0;

    void count(const Sides& sides, const Vec3& p, double value, double tolerance = 1e-12) {
        const bool sure = std::abs(sides.distance(p)) > sides.unsure;
        none += std::isnan(value) ? 1 : 0;
        mixed += !(std::abs(value - std::round(value)) <= tolerance) ? 1 : 0;
        across += sure && !(std::abs(value - sides.value(p)) <= 0.5) ? 1 : 0;
    }
};

void require_sides(const Sides& sides) {
    BuildReport report;
    const Model model = built(sides, report);
    for (const BarrierAccount& account : report.barriers) {
        INFO(account.name << ": " << account.reason);
        REQUIRE(account.used);
    }
    const BarrierQuery faults = model_proximity(model);
    Wrong at_vertices;
    std::vector<ValueQuery> queries;
    for (std::size_t v = 0; v < model.vertices.size(); ++v) {
        const Vertex& vertex = model.vertices[v];
        at_vertices.count(sides, vertex.position, model.vertex_values.values[0][v]);
        queries.push_back({vertex.position, vertex.role == Role::seed ? vertex.owner : -1, vertex.side});
    }
    INFO(at_vertices.mixed << " mixed and " << at_vertices.across << " across of " << model.vertices.size()
                           << " vertices");
    CHECK(at_vertices.mixed + at_vertices.across == 0);
    for (const std::string spec :
         {"laplace", "linear", "idw", "nearest", "kriging:nugget=0:sill=1:range=500:ratio3=1"}) {
        const ValueBatch batch = ModelEstimator(model, faults, parse_estimator(spec)).values(queries);
        Wrong wrong;
        for (std::size_t i = 0; i < queries.size(); ++i) {
            wrong.count(sides, queries[i].position, batch.values[0][i]);
        }
        INFO(spec << ": " << wrong.mixed << " mixed, " << wrong.across << " across, " << wrong.none << " without");
        CHECK(wrong.mixed + wrong.across + wrong.none == 0);
    }
    const TetMesh mesh = tessellate(model).mesh();
    const CellTable cells = describe_cells(model, mesh);
    const OwnSide own(mesh, cells.barrier, faults, model.domain.extent);
    LinearField field{&mesh, model.vertex_values.values[0]};
    field.sides = &own;
    const Lattice lattice = lattice_over(model.domain.extent, {17, 17, 17});
    const std::vector<float> voxels = resample_dense(field, lattice);
    Wrong in_voxels;
    for (std::int64_t i = 0, n = 0; i < lattice.size[0]; ++i) {
        for (std::int64_t j = 0; j < lattice.size[1]; ++j) {
            for (std::int64_t k = 0; k < lattice.size[2]; ++k) {
                const Vec3 p = lattice.center(i, j, k);
                if (model.domain.extent.contains(p)) {
                    in_voxels.count(sides, p, static_cast<double>(voxels[static_cast<std::size_t>(n)]), 1e-6);
                }
                ++n;
            }
        }
    }
    INFO(in_voxels.mixed << " mixed and " << in_voxels.across << " across of " << voxels.size() << " voxels");
    CHECK(in_voxels.mixed + in_voxels.across == 0);
}

/// Values to both sides of x = 500; on it they are for the fault's + side to say.
void part_at_500(Sides& sides) {
    sides.value = [](const Vec3& p) { return p.x > 500 ? 1 : 0; };
    sides.distance = [](const Vec3& p) { return p.x - 500; };
}

/// x = at, over everything.
Surface wall(const std::string& name, double at, double beyond) {
    const double size = 1000 + 2 * beyond;
    return sheet(name, 6, 6, [=](double u, double v) { return Vec3{at, size * u - beyond, size * v - beyond}; });
}

}  // namespace

TEST_CASE("E1: a fault larger than the data parts all of the hull box") {
    Sides sides;
    sides.faults = {wall("F", 500, 4000)};
    part_at_500(sides);
    require_sides(sides);
}

TEST_CASE("E1: a fault that ends where the extent ends parts all of the hull box") {
    Sides sides;
    sides.extent = {{0, 0, 0}, {1000, 1000, 1000}};
    sides.faults = {wall("F", 500, 0)};
    part_at_500(sides);
    require_sides(sides);
}

TEST_CASE("E1: an oblique fault parts all of the hull box, corners included") {
    Sides sides;
    const auto level = [](const Vec3& p) { return (p.x - 480) + 0.4 * (p.y - 500) + 0.8 * (p.z - 300); };
    sides.faults = {sheet("F", 8, 8, [](double u, double v) {
        const double y = -2000 + 5000 * u;
        const double z = -2000 + 5000 * v;
        return Vec3{480 - 0.4 * (y - 500) - 0.8 * (z - 300), y, z};
    })};
    sides.value = [=](const Vec3& p) { return level(p) > 0 ? 1 : 0; };
    sides.distance = level;
    sides.unsure = 1e-3;
    require_sides(sides);
}

TEST_CASE("E1: where a fault ends on another their continuations beyond the extent part three blocks") {
    for (const double lean : {-0.5, 0.0, 0.5}) {  // of the branch against the height
        INFO("lean " << lean);
        Sides sides;
        const auto branch = [=](const Vec3& p) { return p.y - 450 - 0.3 * (p.x - 500) - lean * (p.z - 300); };
        sides.faults = {wall("main", 500, 2000), sheet("branch", 8, 8, [=](double u, double v) {
                            const double x = 500 + 2500 * u;
                            const double z = -1500 + 3500 * v;
                            return Vec3{x, 450 + 0.3 * (x - 500) + lean * (z - 300), z};
                        })};
        sides.value = [=](const Vec3& p) { return p.x < 500 ? 0 : branch(p) > 0 ? 2 : 1; };
        sides.distance = [=](const Vec3& p) { return std::min(std::abs(p.x - 500), std::abs(branch(p))); };
        sides.unsure = 1e-3;
        require_sides(sides);
    }
}

TEST_CASE("E1: with samples beyond the extent a bent fault bars along the surface as it was read") {
    const auto bend = [](double y) { return 500 + 300 * std::sin(y / 400); };
    Sides sides;
    sides.samples = {{0, 100, 0}, {1100, 1100, 600}};
    sides.extent = {{200, 300, 100}, {900, 900, 500}};
    sides.count = 500;
    sides.faults = {sheet("F", 200, 4, [&](double u, double v) {
        const double y = -3000 + 7000 * u;
        return Vec3{bend(y), y, -2000 + 5000 * v};
    })};
    sides.distance = [&](const Vec3& p) { return p.x - bend(p.y); };
    sides.value = [&](const Vec3& p) { return p.x > bend(p.y) ? 1 : 0; };
    sides.unsure = 12;  // triangles of 60 m on a radius of 500 m, and what extrapolates them
    require_sides(sides);
}

TEST_CASE("A fault that ends within the extent is seen past beyond it as well") {
    Sides sides;
    sides.extent = {{0, 0, 0}, {1000, 1000, 600}};
    sides.faults = {sheet("half", 6, 6, [](double u, double v) {
        return Vec3{500, -1000 + 3000 * u, -1000 + 1300 * v};
    })};
    sides.value = [](const Vec3& p) { return p.x > 500 ? 1 : 0; };
    BuildReport report;
    const Model model = built(sides, report);
    const BarrierQuery faults = model_proximity(model);
    for (const double y : {-40.0, 500.0, 1040.0}) {
        CHECK_FALSE(faults.crosses_any({400, y, 320}, {600, y, 320}));  // above its upper rim, beyond the extent too
        CHECK(faults.crosses_any({400, y, 280}, {600, y, 280}));
        CHECK(faults.openness({400, y, 330}, {600, y, 330}) == Approx(0.5).margin(1e-6));
    }
    CHECK(faults.crosses_any({400, 500, -200}, {600, 500, -200}));
    CHECK(faults.openness({400, 500, -100}, {600, 350, -100}) == 0);
    CHECK(faults.openness({400, 500, 100}, {400, 1300, 100}) == 1);  // no rim where the extent ends
}

TEST_CASE("A continuation stops at the fault that its own ends on, however obliquely they meet") {
    for (const double lean : {-0.6, 0.6}) {
        Sides sides;
        sides.extent = {{0, 0, 0}, {1000, 1000, 600}};
        sides.faults = {wall("main", 500, 0), sheet("branch", 8, 8, [=](double u, double v) {
                            const double x = 500 + 600 * u;
                            const double z = -100 + 800 * v;
                            return Vec3{x, 500 + lean * (z - 300), z};
                        })};
        sides.value = [](const Vec3& p) { return p.x > 500 ? 1 : 0; };
        BuildReport report;
        const Model model = built(sides, report);
        const EstimationBarriers barriers = estimation_barriers(model, model.domain, model.barriers);
        REQUIRE(barriers.soft.size() == 2);
        for (std::size_t f = 0; f < 2; ++f) {
            INFO(model.barriers[f].name);
            REQUIRE(!barriers.soft[f].beyond.triangles.empty());
            for (const Vec3& p : barriers.soft[f].beyond.vertices) {
                INFO(p.x << " " << p.y << " " << p.z);
                REQUIRE((model.barriers[f].name == "main" || p.x > 500 - 10));  // the junction is remeshed
            }
        }
    }
}

TEST_CASE("A query exactly on a fault has the value of the side that is asked for, the + side by default") {
    Sides sides;
    sides.faults = {wall("F", 500, 4000)};
    sides.value = [](const Vec3& p) { return p.x > 500 ? 1 : 0; };
    BuildReport report;
    Model model = built(sides, report);
    const BarrierQuery faults = model_proximity(model);
    const double plus = faults.side_of(0, {510, 500, 300}) > 0 ? 1 : 0;
    const std::vector<Vec3> on = {{500, 300, 200}, {500, 412.5, 333.3}, {500, -200, 900}, {500, 0, 0}};
    const auto values_of = [&](const Model& of, const std::string& spec, std::int32_t fault, std::int8_t side) {
        std::vector<ValueQuery> queries;
        for (const Vec3& p : on) {
            queries.push_back({p, fault, side});
        }
        return ModelEstimator(of, faults, parse_estimator(spec)).values(queries).values[0];
    };
    for (const std::string spec : {"natural", "natural:smooth", "laplace", "linear", "idw", "nearest",
                                   "kriging:nugget=0:sill=1:range=500:ratio3=1"}) {
        for (const std::int32_t fault : {-1, 0}) {
            for (const std::int8_t side : {-1, 0, 1}) {
                INFO(spec << ", fault " << fault << ", side " << int(side));
                for (const double value : values_of(model, spec, fault, side)) {
                    CHECK(value == Approx(side < 0 ? 1 - plus : plus).margin(1e-9));
                }
            }
        }
    }
    // A sample on the fault is of its + side: its value is there, and says nothing on the other.
    model.samples.positions.push_back(on[0]);
    model.samples.borehole.push_back(-1);
    model.samples.depth.push_back(missing);
    model.samples.length.push_back(0);
    model.samples.values[0].push_back(7);
    for (const std::string spec : {"natural", "idw", "nearest"}) {
        CHECK(values_of(model, spec, -1, 1)[0] == 7);
        CHECK(values_of(model, spec, -1, -1)[0] == Approx(1 - plus).margin(1e-9));
    }
}

TEST_CASE(
    "A hard horizon parts the properties that it is hard for, 99 of 100 places within 10 m of it, and no others") {
    const auto contact = [](double x, double y) { return 300 + 40 * std::sin(x / 150) + 0.1 * (y - 500); };
    Site site;
    site.properties = {{"grade", "", Scale::linear, Kind::continuous, {}},
                       {"rock", "", Scale::linear, Kind::categorical, {"above", "below"}},
                       {"soft rock", "", Scale::linear, Kind::categorical, {"above", "below"}},
                       {"step", "", Scale::linear, Kind::continuous, {}}};
    site.properties[1].hard_horizons = site.properties[3].hard_horizons = true;
    site.samples.values.resize(4);
    Random random(5);
    for (int hole = 0; hole < 30; ++hole) {
        const Vec3 collar = random.in({{0, 0, 600}, {1000, 1000, 600}});
        for (double z = 5; z < 600; z += 10) {
            if (std::abs(z - contact(collar.x, collar.y)) < 1) {
                continue;  // nearer than remeshing moves the horizon: of either side
            }
            const double below = z < contact(collar.x, collar.y) ? 1 : 0;
            site.samples.positions.push_back({collar.x, collar.y, z});
            site.samples.borehole.push_back(-1);
            site.samples.depth.push_back(missing);
            site.samples.length.push_back(0);
            const std::array<double, 4> values{collar.x + z, below, below, below};
            for (std::size_t p = 0; p < 4; ++p) {
                site.samples.values[p].push_back(values[p]);
            }
        }
    }
    site.surfaces = {sheet("top", 60, 60, [&](double u, double v) {
        const double x = -300 + 1600 * u;
        const double y = -300 + 1600 * v;
        return Vec3{x, y, contact(x, y)};
    })};
    site.surfaces[0].kind = SurfaceKind::horizon;
    BuildOptions options;
    options.criteria.l_min = 50;
    options.criteria.l_max = 200;
    options.barriers.spacing = 35;
    BuildReport report;
    const auto factory = [](const Model& model, const BarrierQuery& faults) {
        return make_model_source(model, faults, {});
    };
    const Model model = std::move(build(site, options, factory, report)->model);
    REQUIRE(model.barriers.size() == 1);
    const BarrierQuery faults = model_proximity(model);
    CHECK_FALSE(faults.crosses_any({500, 500, 200}, {500, 500, 500}));
    CHECK(faults.seen_by(1).crosses_any({500, 500, 200}, {500, 500, 500}));
    std::vector<ValueQuery> queries;
    for (int i = 0; i < 4000; ++i) {
        Vec3 p = random.in({{100, 100, -10}, {900, 900, 10}});
        p.z += contact(p.x, p.y);
        queries.push_back({p});
    }
    for (const std::string spec : {"natural", "idw", "nearest"}) {
        const ValueBatch batch = ModelEstimator(model, faults, parse_estimator(spec)).values(queries);
        std::array<std::size_t, 4> right{};
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const Vec3& p = queries[i].position;
            const double below = p.z < contact(p.x, p.y) ? 1 : 0;
            for (const std::size_t n : {1, 2, 3}) {
                right[n] += std::abs(batch.values[n][i] - below) < 1e-9 ? 1 : 0;
            }
        }
        INFO(spec << ": of 4000 right " << right[1] << " hard, " << right[2] << " soft, " << right[3] << " step");
        CHECK(right[1] >= 3960);
        CHECK(right[3] >= 3960);
        CHECK(right[2] < 3800);
    }
    // The others are what they are without.
    Site soft = site;
    soft.properties[1].hard_horizons = soft.properties[3].hard_horizons = false;
    BuildReport soft_report;
    const Model without = std::move(build(soft, options, factory, soft_report)->model);
    CHECK(report.final.regions == soft_report.final.regions);
    const auto of_hard = ModelEstimator(model, faults, {}).values(queries);
    const auto of_soft = ModelEstimator(without, model_proximity(without), {}).values(queries);
    CHECK(same_bits(of_hard.values[0], of_soft.values[0]));
    CHECK(same_bits(of_hard.values[2], of_soft.values[2]));
    // Voxels, those in the gap between the horizon's seeds included.
    const TetMesh mesh = tessellate(model).mesh();
    const CellTable cells = describe_cells(model, mesh);
    const OwnSide own(mesh, cells.barrier, faults.seen_by(3), model.domain.extent);
    LinearField field{&mesh, model.vertex_values.values[3]};
    field.sides = &own;
    const Lattice lattice = lattice_over(model.domain.extent, {13, 13, 13});
    const auto voxels = resample_dense(field, lattice);
    CHECK(std::ranges::all_of(voxels, [](float v) { return std::isnan(v) || v < 1e-6F || v > 1 - 1e-6F; }));
}
