// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/build.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <unordered_set>

#include "tess/cells/crossing_edges.hpp"
#include "tess/edit/boundary.hpp"
#include "tess/edit/build_defaults.hpp"
#include "tess/edit/build_tolerance.hpp"
#include "tess/edit/close_crossings.hpp"
#include "tess/edit/default_spacing.hpp"
#include "tess/edit/given_values.hpp"
#include "tess/edit/vertex_demand.hpp"
#include "tess/error.hpp"
#include "tess/model/block_finder.hpp"
#include "tess/model/density_edition.hpp"
#include "tess/refine/refine.hpp"
#include "tess/site/canonical_site.hpp"

namespace terratet {

namespace {

/// How often a build begins anew where an edge has crossed a fault: that is rare, and once is enough nearly always.
constexpr int most_rounds = 8;

class Stopwatch {
  public:
    explicit Stopwatch(double& seconds) : seconds_(seconds), start_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

  private:
    double& seconds_;
    std::chrono::steady_clock::time_point start_;
};

/// The samples that lie in the extent, as indices.
std::vector<std::uint32_t> inside_extent(const Model& model, BuildReport& report) {
    std::vector<std::uint32_t> inside;
    for (std::uint32_t i = 0; i < model.samples.size(); ++i) {
        if (model.domain.extent.contains(model.samples.positions[i])) {
            inside.push_back(i);
        }
    }
    report.outside_extent = model.samples.size() - inside.size();
    return inside;
}

DensityResult thin(const Model& model, const std::vector<std::uint32_t>& inside, DensityMode mode,
                   const BarrierQuery& proximity, const Poll& poll) {
    DensityResult result =
        edit_density(selected(model.samples, inside), ResolutionField(model.criteria, model.domain, model.barriers),
                     mode, proximity, poll);
    for (auto* indices : {&result.kept, &result.near_faults}) {
        for (std::uint32_t& i : *indices) {
            i = inside[i];
        }
    }
    return result;
}

struct PositionHash {
    std::size_t operator()(const Vec3& p) const {
        std::size_t h = 0;
        for (const double x : {p.x, p.y, p.z}) {
            h = h * 0x9e3779b97f4a7c15U + std::hash<double>()(x);
        }
        return h;
    }
};

/// The initial vertices with their ids, in canonical order: samples, seeds, box.
class InitialVertices {
  public:
    explicit InitialVertices(Model& model) : model_(model) {}

    void add(const Vec3& position, Role role, std::int32_t owner, std::int8_t side) {
        if (model_.domain.hull.contains(position) && taken_.insert(position).second) {
            model_.vertices.push_back({model_.vertices.size(), position, role, owner, side});
        }
    }

    void add_samples(const std::vector<std::uint32_t>& kept) {
        for (const std::uint32_t i : kept) {
            add(model_.samples.positions[i], Role::sample, static_cast<std::int32_t>(i), 0);
        }
    }
    void add_seeds() {
        for (std::size_t f = 0; f < model_.barriers.size(); ++f) {
            for (const Seed& seed : model_.barriers[f].seeds) {
                add(seed.position, Role::seed, static_cast<std::int32_t>(f), seed.side);
            }
        }
    }
    void add_box(const Poll& poll) {
        std::vector<Vec3> obstacles;
        for (const Vertex& vertex : model_.vertices) {
            obstacles.push_back(vertex.position);
        }
        for (const Vec3& p : face_grid(model_.domain.hull, model_.criteria.l_min, longest_on_faces(model_.criteria),
                                       obstacles, model_.frame, poll)) {
            add(p, Role::domain, -1, 0);
        }
    }

  private:
    Model& model_;
    std::unordered_set<Vec3, PositionHash> taken_;
};

CellStatistics initial_statistics(const TessellatedModel& built) {
    const TetMesh mesh = built.tessellation->mesh();
    return cell_statistics(built.model, mesh, measure_cells(built.model, mesh, *built.barriers), *built.barriers);
}

/// Of all that was refined: the tables that stay, and what the report says of them.
void describe(TessellatedModel& built, BuildReport& report) {
    built.cells = describe_cells(built.model, built.mesh, *built.barriers);
    for (const Reason reason : built.cells.reason) {
        if (reason != Reason::none && reason != Reason::fault_gap) {
            ++report.refine.skipped[reason];
        }
    }
    report.fidelity = fidelity(built.model, built.mesh, built.cells.barrier, *built.barriers);
    report.empty_blocks = empty_blocks(built.model, built.mesh, built.cells);
    report.final = cell_statistics(built.model, built.mesh, built.cells, *built.barriers);
}

/// Vertices, values and tessellation of a model whose site and boundary are ready.
void tessellate(TessellatedModel& built, const BuildOptions& options, const ValueSourceFactory& factory,
                BuildReport& report, const Progress& progress) {
    Model& model = built.model;
    model.vertices.clear();
    built.barriers = model_proximity(model);
    const BarrierQuery& proximity = *built.barriers;
    InitialVertices initial(model);
    {
        const Stopwatch watch(report.seconds["density"]);
        const Poll thinning = [&] { report_progress(progress, "density", 0); };
        thinning();
        const std::vector<std::uint32_t> inside = inside_extent(model, report);
        retain_samples(options, inside, proximity, model, thinning);
        report.density = thin(model, inside, options.density, proximity, thinning);
        initial.add_samples(report.density.kept);
    }
    {
        const Stopwatch watch(report.seconds["boundary"]);
        initial.add_seeds();
        report.seeds = model.vertices.size() - report.density.kept.size();
        initial.add_box([&] { report_progress(progress, "boundary", 0); });
        report.domain_vertices = model.vertices.size() - report.density.kept.size() - report.seeds;
    }
    ValueSource source;
    double& estimating = report.seconds["estimate"];
    {
        const Stopwatch watch(estimating);
        report_progress(progress, "estimate", 0);
        source = factory(model, proximity);
        set_residual_limits(options, model);
        model.vertex_values = measured_or_estimated(model, source);
    }
    const ValueSource timed_source = [&](std::span<const ValueQuery> queries) {
        const Stopwatch watch(estimating);
        return source(queries);
    };
    Tessellation& tessellation = built.tessellation.emplace();
    const Stopwatch watch(report.seconds["refine"]);
    tessellation.insert(model.vertices, [&] { report_progress(progress, "tessellate", 0); });
    report.initial = initial_statistics(built);
    report.refine = {};
    if (options.refine_enabled) {
        RefineOptions refine_options = options.refine;
        refine_options.progress = progress;
        refine_options.enough_vertices = enough_vertices(options, model);
        const double before = estimating;
        report.refine = refine(tessellation, model.vertex_values, model.domain, model.frame, proximity, model.criteria,
                               model.properties, timed_source, refine_options, dropped_samples(model, proximity));
        report.seconds["refine"] -= estimating - before;
    }
    model.vertices.assign(tessellation.vertices().begin(), tessellation.vertices().end());
    built.mesh = tessellation.mesh();
}

}  // namespace

std::unique_ptr<TessellatedModel> build(Site site, const BuildOptions& options, const ValueSourceFactory& factory,
                                        BuildReport& report, const Progress& progress) {
    auto built = std::make_unique<TessellatedModel>();
    Model& model = built->model;
    report.coincident = canonicalise(site);
    static_cast<Site&>(model) = std::move(site);
    resolve_resolution(options, model, report);
    require_affordable(model, options);
    model.density = options.density;
    model.estimator = options.estimator;
    {
        const Stopwatch watch(report.seconds["boundary"]);
        prepare_boundary_at_default_spacing(options, model, report, progress);
        name_regions(options, model);
    }
    const Criteria criteria = model.criteria;
    for (int round = 0;; ++round) {
        model.criteria = criteria;
        tessellate(*built, options, factory, report, progress);
        const auto crossing = fault_crossing_edges(model, built->mesh, *built->barriers);
        report.fault_crossing_edges = crossing.size();
        if (crossing.empty() || round == most_rounds || !close_crossings(crossing, built->mesh, model)) {
            break;
        }
    }
    const Stopwatch watch(report.seconds["refine"]);
    if (options.refine_enabled) {
        keep_l_min_between(model, report);
    }
    describe(*built, report);
    note_lost_field(model, report);
    return built;
}

BuildOptions options_of(const Model& model) {
    BuildOptions options;
    options.extent = model.domain.extent;
    options.criteria = model.criteria;
    options.region_names = model.region_names;
    options.density = model.density;
    options.barriers = model.barrier_options;
    options.estimator = model.estimator;
    options.default_tolerance = false;
    options.estimator_noise = stored_noise(model);
    return options;
}

}  // namespace terratet
