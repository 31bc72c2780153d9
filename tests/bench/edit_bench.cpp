// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// Edits of a model in memory, against building it, and against CGAL's own removal and insertion of as many vertices
/// as the edit removes and adds. Medians and 95th percentiles, in milliseconds: wall and the process' CPU.
///
///   edit_bench [WELLS=40] [EDITS=200] [ESTIMATOR=natural:anisotropy=none] [L_MAX=120]

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "interp/live_model.hpp"
#include "support.hpp"
#include "tess/site_edits.hpp"
#include "timing.hpp"

using namespace terratet;
using namespace terratet::bench;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Delaunay = CGAL::Delaunay_triangulation_3<Kernel>;

constexpr double well_distance = 200;
constexpr double depth = 500;
constexpr int samples_a_well = 100;

double field(const Vec3& p) {
    return std::sin(p.x / 300) + std::cos(p.y / 250) + 0.002 * p.z;
}

std::string well_name(int well) {
    char name[16];
    std::snprintf(name, sizeof name, "W%06d", well);
    return name;
}

/// Wells on a shaken square lattice, a sample each 5 m.
Site site_of(int wells) {
    testing::Random random(1);
    Site site;
    site.properties = {{"f", "", Scale::linear, Kind::continuous, {}}};
    site.samples.values.resize(1);
    const int across = static_cast<int>(std::ceil(std::sqrt(wells)));
    for (int w = 0; w < wells; ++w) {
        const Vec3 collar{(w % across + random(0.2, 0.8)) * well_distance,
                          (w / across + random(0.2, 0.8)) * well_distance, 0};
        const Vec3 lean{random(-0.05, 0.05), random(-0.05, 0.05), -1};
        Borehole hole{well_name(w), collar, {collar, collar + depth * lean}, {0, depth}};
        for (int i = 0; i < samples_a_well; ++i) {
            const double at = (i + 0.5) * depth / samples_a_well;
            const Vec3 p = site.frame.snapped(collar + at * lean);
            site.samples.positions.push_back(p);
            site.samples.borehole.push_back(w);
            site.samples.depth.push_back(at);
            site.samples.length.push_back(0);
            site.samples.values[0].push_back(field(p));
        }
        site.boreholes.push_back(std::move(hole));
    }
    return site;
}

/// A tilted sheet of 2,000 triangles in the middle.
Surface fault_at(const Vec3& middle) {
    Surface fault;
    fault.name = "F";
    constexpr int n = 40, m = 25;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= m; ++j) {
            fault.vertices.push_back(
                middle + Vec3{(i - n / 2.0) * 10, (j - m / 2.0) * 3 + 5 * std::sin(i / 6.0), (j - m / 2.0) * 10});
        }
    }
    const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (m + 1) + j); };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            fault.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            fault.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    return fault;
}

struct Times {
    std::vector<double> wall, cpu, removed, added;

    [[nodiscard]] static double part(std::vector<double> values, double share) {
        std::sort(values.begin(), values.end());
        return values[std::min(values.size() - 1,
                               static_cast<std::size_t>(share * static_cast<double>(values.size())))];
    }
};

/// `change` makes the i-th plan from what is there.
Times timed(LiveModel& live, int count, const std::function<void(ModelPlan&, int)>& change) {
    Times times;
    for (int i = 0; i < count; ++i) {
        const double wall = wall_s(), cpu = process_cpu_s();
        ModelPlan plan = plan_of(live.model());
        change(plan, i);
        const ChangeReport report = live.edit(std::move(plan));
        times.wall.push_back(1000 * (wall_s() - wall));
        times.cpu.push_back(1000 * (process_cpu_s() - cpu));
        times.removed.push_back(static_cast<double>(report.samples_out + report.seeds_out + report.inserted_out));
        times.added.push_back(static_cast<double>(report.samples_in + report.seeds_in + report.refine.inserted));
    }
    return times;
}

/// CGAL's own: as many vertices near each other out and in again, milliseconds.
double exchange_alone(const Model& model, std::size_t count) {
    std::vector<Kernel::Point_3> points;
    for (const Vertex& v : model.vertices) {
        points.emplace_back(v.position.x, v.position.y, v.position.z);
    }
    Delaunay delaunay(points.begin(), points.end());
    std::vector<double> times;
    testing::Random random(7);
    for (int i = 0; i < 20; ++i) {
        const Vec3 from = model.vertices[random.below(model.vertices.size())].position;
        std::vector<Delaunay::Vertex_handle> near{delaunay.nearest_vertex({from.x, from.y, from.z})};
        for (std::size_t k = 0; k < near.size() && near.size() < count; ++k) {
            std::vector<Delaunay::Vertex_handle> next;
            delaunay.finite_adjacent_vertices(near[k], std::back_inserter(next));
            for (const auto v : next) {
                if (near.size() < count && std::find(near.begin(), near.end(), v) == near.end()) {
                    near.push_back(v);
                }
            }
        }
        std::vector<Kernel::Point_3> places;
        const double start = wall_s();
        for (const auto v : near) {
            places.push_back(v->point());
            delaunay.remove(v);
        }
        Delaunay::Cell_handle hint;
        for (const auto& p : places) {
            hint = delaunay.insert(p, hint)->cell();
        }
        times.push_back(1000 * (wall_s() - start));
    }
    return Times::part(times, 0.5);
}

void print(const char* name, const Times& t, const LiveModel& live) {
    const double exchanged = (Times::part(t.removed, 0.5) + Times::part(t.added, 0.5)) / 2;
    const double alone = exchange_alone(live.model(), std::max<std::size_t>(1, static_cast<std::size_t>(exchanged)));
    std::printf("| %s | %.1f | %.1f | %.1f | %.1f | %.0f | %.0f | %.1f |\n", name, Times::part(t.wall, 0.5),
                Times::part(t.wall, 0.95), Times::part(t.cpu, 0.5), Times::part(t.cpu, 0.95),
                Times::part(t.removed, 0.5), Times::part(t.added, 0.5), alone);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const int wells = argc > 1 ? std::atoi(argv[1]) : 40;
    const int edits = argc > 2 ? std::atoi(argv[2]) : 200;
    BuildOptions options;
    options.estimator = argc > 3 ? argv[3] : "natural:anisotropy=none";
    options.criteria.l_min = 30;
    options.criteria.l_max = argc > 4 ? std::atof(argv[4]) : 120;
    const double wall = wall_s(), cpu = process_cpu_s();
    LiveModel live(site_of(wells), options);
    std::printf("%d wells, %zu samples, %zu vertices, %s; built in %.2f s, CPU %.2f s\n\n", wells,
                live.model().samples.size(), live.model().vertices.size(), live.model().estimator.c_str(),
                wall_s() - wall, process_cpu_s() - cpu);
    std::printf(
        "| edit | median, ms | p95, ms | CPU median | CPU p95 | vertices out | in | CGAL's exchange alone, ms "
        "|\n|---|---|---|---|---|---|---|---|\n");
    std::fflush(stdout);
    testing::Random random(3);
    const Box3 extent = live.model().domain.extent;
    const Vec3 size = extent.size();
    timed(live, 1, [&](ModelPlan& plan, int) { move_borehole(plan.site, well_name(wells / 2), {7, 3, 0}); });
    print("move a well",
          timed(live, edits,
                [&](ModelPlan& plan, int) {
                    const auto id = well_name(static_cast<int>(random.below(static_cast<std::uint64_t>(wells))));
                    move_borehole(plan.site, id, plan.site.frame.snapped({random(-10, 10), random(-10, 10), 0}));
                }),
          live);
    const auto criteria = live.model().criteria;
    print(
        "a box twice as fine",
        timed(live, edits,
              [&](ModelPlan& plan, int) {
                  const Vec3 lo = extent.lo + Vec3{random(0.1, 0.8) * size.x, random(0.1, 0.8) * size.y, 0.3 * size.z};
                  plan.criteria = criteria;
                  plan.criteria.overrides.push_back(
                      {ResolutionOverride::Where::box, {lo, lo + Vec3{100, 100, 100}}, {}, 15, 60});
              }),
        live);
    print("a fault out and in",
          timed(live, edits,
                [&](ModelPlan& plan, int i) {
                    if (i % 2 == 1) {
                        remove_surface(plan.site, "F");
                    } else {
                        plan.site.surfaces.push_back(fault_at(
                            extent.center() + Vec3{random(-0.3, 0.3) * size.x, random(-0.3, 0.3) * size.y, 0}));
                    }
                }),
          live);
    return 0;
}
