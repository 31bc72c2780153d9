// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>

#include "tess/mesh/mesh_walk.hpp"
#include "tess/model/resolution.hpp"
#include "tess/verify.hpp"
#include "tests/tess/worlds.hpp"

using namespace terratet;

namespace {

using Field = double (*)(const Vec3&);

double layered(const Vec3& p) {
    return std::sin(p.x / 60) + p.y / 200 + std::exp(-std::pow((p.z + 100 - 0.2 * p.x) / 15, 2));
}
double linear(const Vec3& p) {
    return 0.01 * p.x - 0.02 * p.y + 0.03 * p.z;
}

/// P1 is the field, P2 its power of ten.
ValueSourceFactory source_of(Field field) {
    return [field](const Model&, const BarrierQuery&) -> ValueSource {
        return [field](std::span<const ValueQuery> queries) {
            ValueBatch batch{{{}, {}}, std::vector<double>(queries.size(), 0)};
            for (const ValueQuery& query : queries) {
                batch.values[0].push_back(field(query.position));
                batch.values[1].push_back(std::pow(10.0, field(query.position)));
            }
            return batch;
        };
    };
}

/// A random world whose samples measure the field.
testing::World world_of(std::uint64_t seed, Field field, double tolerance) {
    testing::World world = testing::random_world(seed);
    Site& site = world.site;
    site.properties = {{"P1", "", Scale::linear, Kind::continuous, {}, false},
                       {"P2", "", Scale::log10, Kind::continuous, {}, false}};
    for (std::size_t i = 0; i < site.samples.size(); ++i) {
        const double value = field(site.samples.positions[i]);
        site.samples.values[0][i] = std::isnan(site.samples.values[0][i]) ? missing : value;
        site.samples.values[1][i] = std::pow(10.0, value);
    }
    site.samples.censored.clear();
    const double l_min = world.options.criteria.l_min;
    world.options.criteria = {};
    world.options.criteria.l_min = l_min;  // else it would follow from how far the samples reach: faults of any density
    world.options.criteria.l_min_between = l_min / 20;
    VariationLimits limits;
    limits.tolerance = tolerance;
    world.options.criteria.variation = {limits, limits};
    world.options.density = DensityMode::canonical;
    return world;
}

struct Counts {
    std::size_t places = 0;
    std::size_t beyond = 0;
    std::size_t excused = 0;  ///< places in cells with a reason
};

/// The field against the linear one at random places.
Counts compared(const TessellatedModel& built, Field field, double tolerance, std::size_t count, std::uint64_t seed) {
    testing::Random random(seed);
    MeshWalk walk(built.mesh);
    Counts counts;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = random.in(built.model.domain.extent);
        const auto in = walk.locate(p);
        if (!in || built.cells.barrier[in->cell] >= 0) {
            continue;
        }
        ++counts.places;
        const Reason reason = built.cells.reason[in->cell];
        if (reason != Reason::none && reason != Reason::smooth) {
            ++counts.excused;
            continue;
        }
        double value = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            value += in->weights[k] * built.model.vertex_values.values[0][built.mesh.cells[in->cell][k]];
        }
        counts.beyond += std::abs(value - field(p)) > tolerance ? 1 : 0;
    }
    return counts;
}

std::unique_ptr<TessellatedModel> built(const testing::World& world, Field field, BuildReport& report) {
    return build(world.site, world.options, source_of(field), report);
}

}  // namespace

TEST_CASE("T1: the field is within the tolerance between samples but for cells with a reason, in 50 worlds") {
    constexpr double tolerance = 0.3;
    Counts all;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        testing::World world = world_of(seed, layered, tolerance);
        if (seed >= 10) {  // faults take their time
            world.site.surfaces.clear();
        }
        BuildReport report;
        const auto made = built(world, layered, report);
        const Counts counts = compared(*made, layered, tolerance, 20'000, seed);
        INFO(seed << " " << world.description << ": " << counts.beyond << " of " << counts.places);
        CHECK(counts.beyond <= counts.places / 200);
        all.places += counts.places;
        all.beyond += counts.beyond;
        all.excused += counts.excused;
    }
    INFO(all.beyond << " beyond, " << all.excused << " excused of " << all.places);
    CHECK(all.beyond <= all.places / 1000);
    CHECK(all.excused <= all.places / 4);
}

TEST_CASE("T2: every sample is met within the tolerance, or left out for another that is kept within l_min") {
    std::size_t missed = 0;
    std::size_t samples = 0;
    for (const std::uint64_t seed : {3U, 4U, 5U, 7U}) {
        const testing::World world = world_of(seed, layered, 0.3);
        BuildReport report;
        const auto made = built(world, layered, report);
        const Model& model = made->model;
        const ResolutionField resolution(model.criteria, model.domain, model.barriers);
        for (std::size_t p = 0; p < 2; ++p) {
            const Fidelity& fit = report.fidelity[p];
            CHECK(fit.tolerance == 0.3);
            std::size_t explained = 0;
            for (const auto& [reason, count] : fit.reasons) {
                explained += count;
            }
            CHECK(explained == fit.beyond_tolerance);
            missed += fit.reasons.contains(MissReason::too_close) ? fit.reasons.at(MissReason::too_close) : 0;
            samples += fit.count;
        }
        for (const Verdict& verdict : verify(model, source_of(layered))) {
            INFO(seed << " " << world.description << " " << verdict.guarantee << " " << verdict.detail);
            CHECK(verdict.holds);
        }
    }
    CHECK(missed <= samples / 200);
}

TEST_CASE("A linear field inserts nothing for variation") {
    for (const std::uint64_t seed : {3U, 5U, 7U}) {
        testing::World world = world_of(seed, linear, 0.5);
        world.site.surfaces.clear();
        BuildReport report;
        built(world, linear, report);
        INFO(world.description);
        CHECK(report.refine.inserted == 0);
    }
}

TEST_CASE("R7: refining to a tolerance again inserts, moves and removes nothing, asking at every cell") {
    for (const std::uint64_t seed : {5U, 8U}) {
        const testing::World world = world_of(seed, layered, 0.4);
        BuildReport report;
        const auto made = built(world, layered, report);
        CHECK(report.refine.inserted > 0);
        for (const Verdict& verdict : verify(made->model, source_of(layered), {}, false, {.all = true})) {
            INFO(verdict.guarantee << " " << verdict.detail);
            CHECK(verdict.holds);
        }
    }
}

TEST_CASE("l_min between samples goes down by steps until there are enough vertices, is kept, and is come to again") {
    testing::World world = world_of(7, layered, 0.05);
    world.site.surfaces.clear();
    BuildReport all;
    const auto fine = built(world, layered, all);
    CHECK_FALSE(all.refine.stopped);
    CHECK(all.refine.l_min_between == world.options.criteria.l_min_between);
    world.options.refine.enough_vertices = fine->model.vertices.size() / 3;
    BuildReport report;
    const auto made = built(world, layered, report);
    const double l_min = made->model.criteria.l_min_between;
    CHECK(report.refine.stopped);
    CHECK(l_min > world.options.criteria.l_min_between);
    CHECK(l_min < world.options.criteria.l_min);
    CHECK(made->model.vertices.size() <= world.options.refine.enough_vertices);
    CHECK(report.refine.skipped.at(Reason::too_close) > 0);
    CHECK(std::ranges::any_of(report.diagnostics.notes, [](const std::string& note) {
        return note.find("vertices between samples keep") != note.npos;
    }));
    for (const Verdict& verdict : verify(made->model, source_of(layered))) {  // R6 and R7 among them
        INFO(verdict.guarantee << " " << verdict.detail);
        CHECK(verdict.holds);
    }
    testing::World other = world;
    bool odd = false;
    for (const std::size_t part : {2, 3, 4, 6}) {  // every step is by √2
        other.options.refine.enough_vertices = fine->model.vertices.size() / part;
        BuildReport of_part;
        const double reached = built(other, layered, of_part)->model.criteria.l_min_between;
        const double steps = 2 * std::log2(world.options.criteria.l_min / reached);
        CHECK(std::abs(steps - std::round(steps)) < 1e-9);
        odd = odd || std::lround(steps) % 2 == 1;
    }
    CHECK(odd);
    world.options.criteria.l_min_between = l_min;
    world.options.refine.enough_vertices = 0;
    BuildReport again;
    CHECK(built(world, layered, again)->model.vertices == made->model.vertices);
}

TEST_CASE("Where nothing is given a tolerance is chosen; l_min alone keeps its old meaning and says what it lost") {
    testing::World world = world_of(7, layered, 0);
    world.options.criteria = {};
    BuildReport report;
    const auto chosen = built(world, layered, report);
    CHECK(chosen->model.criteria.variation[0].tolerance > 0);
    CHECK(report.fidelity[0].r2 > 0.95);
    world.options.criteria.l_min = 60;
    BuildReport coarse;
    const auto old = built(world, layered, coarse);
    CHECK_FALSE(old->model.criteria.has_tolerance());
    CHECK(coarse.fidelity[0].r2 < 0.9);
    CHECK(std::ranges::any_of(coarse.diagnostics.notes,
                              [](const std::string& note) { return note.find("`tolerance` P1=") != note.npos; }));
}
