// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/build.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>
#include <unordered_set>

#include "tess/barrier/prepare/prepare.hpp"
#include "tess/base/box_clip.hpp"
#include "tess/cells/crossing_edges.hpp"
#include "tess/edit/build_defaults.hpp"
#include "tess/edit/vertex_demand.hpp"
#include "tess/error.hpp"
#include "tess/model/block_finder.hpp"
#include "tess/model/density_edition.hpp"
#include "tess/refine/refine.hpp"

namespace terratet {

namespace {

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

/// Boreholes by id, samples in canonical order and without coincident ones, surfaces in theirs.
void canonicalise(Site& site, BuildReport& report) {
    std::vector<std::int32_t> order(site.boreholes.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = static_cast<std::int32_t>(i);
    }
    std::ranges::sort(order, {}, [&](std::int32_t i) { return site.boreholes[static_cast<std::size_t>(i)].id; });
    std::vector<std::int32_t> rank(order.size());
    std::vector<Borehole> boreholes;
    for (std::size_t i = 0; i < order.size(); ++i) {
        rank[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(i);
        boreholes.push_back(std::move(site.boreholes[static_cast<std::size_t>(order[i])]));
    }
    site.boreholes = std::move(boreholes);
    for (std::int32_t& owner : site.samples.borehole) {
        owner = owner < 0 ? -1 : rank[static_cast<std::size_t>(owner)];
    }
    site.samples = selected(site.samples, canonical_order(site.samples));
    report.coincident = merge_coincident(site.samples, site.properties).merged;
    std::ranges::stable_sort(site.surfaces, canonical_before);
}

/// Throws UsageError for a topography or a domain in exact mode: its seeds cannot meet on the surface
/// (tess/collapse.hpp).
void require_paired_bounds(const Model& model) {
    for (const Surface& surface : model.surfaces) {
        if (is_bound(surface.kind) && model.barrier_options.mode != SeedMode::paired) {
            throw UsageError("`" + std::string(to_string(surface.kind)) + "` needs `barriers.mode` paired");
        }
    }
}

double area_in_plan(const Domain& domain) {
    const Vec3 size = domain.extent.size();
    Box3 plan = domain.extent;
    plan.lo.z = -1;
    plan.hi.z = 1;
    double clipped_area = 0;
    for (const auto& ring : domain.outline) {  // fans from one point, signed: their parts outside the ring cancel out
        for (std::size_t i = 2; i < ring.size(); ++i) {
            const std::vector<Vec3> part = clipped({ring[0], ring[i - 1], ring[i]}, plan);
            Vec3 twice;
            for (std::size_t k = 2; k < part.size(); ++k) {
                twice = twice + cross(part[k - 1] - part[0], part[k] - part[0]);
            }
            clipped_area += twice.z / 2;
        }
    }
    return domain.outline.empty() ? size.x * size.y : clipped_area;
}

/// Throws InputError when a topography was refused, or does not cover the extent: its cells would end in a staircase.
void require_ground(const Model& model, const BuildReport& report) {
    for (const BarrierAccount& account : report.barriers) {
        if (account.kind == SurfaceKind::topography && !account.used) {
            throw InputError(account.file + ": the topography '" + account.name + "' cannot be used: it " +
                             account.reason);
        }
    }
    double covered = 0;
    bool any = false;
    const Outline outline(model.domain.outline);
    for (const Barrier& barrier : model.barriers) {
        for (const Triangle& t : barrier.sheet.triangles) {
            const Vec3& a = barrier.sheet.vertices[t[0]];
            const Vec3& b = barrier.sheet.vertices[t[1]];
            const Vec3& c = barrier.sheet.vertices[t[2]];
            const bool counts = barrier.sheet.kind == SurfaceKind::topography && outline.contains((a + b + c) / 3);
            covered += counts ? 0.5 * cross(b - a, c - a).z : 0;
            any = any || barrier.sheet.kind == SurfaceKind::topography;
        }
    }
    const double share = std::abs(covered) / area_in_plan(model.domain);
    if (any && std::abs(share - 1) > 1e-3) {
        std::ostringstream text;
        text.precision(4);
        text << "the topography covers " << 100 * share << " % of the "
             << (model.domain.outline.empty() ? "extent" : "domain")
             << "'s area, once each place: it must cover all of "
             << "it, between bottom and top; choose an `extent` within it";
        throw InputError(text.str());
    }
}

/// Throws InputError when a wall of the domain is missing: the model would run out there.
void require_walls(const Model& model, const std::vector<BarrierAccount>& accounts) {
    double wanted = 0;
    for (const auto& ring : model.domain.outline) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            wanted +=
                length_inside(ring[i], ring[(i + 1) % ring.size()], model.domain.extent) * model.domain.extent.size().z;
        }
    }
    double there = 0;
    for (const Barrier& barrier : model.barriers) {
        there += barrier.sheet.kind == SurfaceKind::domain ? statistics(barrier.sheet).area : 0;
    }
    if (std::abs(there - wanted) <= 0.01 * wanted) {
        return;
    }
    std::string why = "give a finer `barriers.spacing`, or smooth the polygon";
    for (const BarrierAccount& account : accounts) {
        if (account.kind == SurfaceKind::domain && !account.used) {
            why = "a part of it " + account.reason;
        }
    }
    std::ostringstream text;
    text.precision(4);
    text << domain_surface(model)->file << ": the model cannot be bounded by this domain, as "
         << 100 * std::abs(there - wanted) / wanted << " % of its walls could not be followed: " << why;
    throw InputError(text.str());
}

/// The walls of the domain are one surface in the report.
void join_walls(const Surface& domain, std::vector<BarrierAccount>& accounts) {
    BarrierAccount joined;
    joined.name = domain.name;
    joined.file = domain.file;
    joined.kind = SurfaceKind::domain;
    for (const BarrierAccount& wall : accounts) {
        if (wall.kind != SurfaceKind::domain) {
            continue;
        }
        joined.used = joined.used || wall.used;
        joined.reason = joined.reason.empty() ? wall.reason : joined.reason;
        joined.parts += wall.parts;
        joined.seeds += wall.seeds;
        joined.triangles += wall.triangles;
        joined.certified += wall.certified;
        joined.unseparated += wall.unseparated;
        joined.finest_spacing =
            joined.finest_spacing == 0 ? wall.finest_spacing : std::min(joined.finest_spacing, wall.finest_spacing);
        joined.area_in += wall.area_in;
        joined.area_used += wall.area_used;
        joined.area_outside += wall.area_outside;
        joined.area_trimmed += wall.area_trimmed;
        joined.area_refused += wall.area_refused;
        joined.deviation_median = std::max(joined.deviation_median, wall.deviation_median);
        joined.deviation_p95 = std::max(joined.deviation_p95, wall.deviation_p95);
        joined.deviation_max = std::max(joined.deviation_max, wall.deviation_max);
        joined.dropped_triangles += wall.dropped_triangles;
    }
    if (!joined.used && joined.reason.empty()) {
        joined.reason = "its boundary lies outside the extent, which it covers";
    }
    std::erase_if(accounts, [](const BarrierAccount& account) { return account.kind == SurfaceKind::domain; });
    const auto at = std::ranges::upper_bound(accounts, joined.name, {}, &BarrierAccount::name);
    accounts.insert(at, std::move(joined));
}

void prepare_boundary(const BuildOptions& options, Model& model, BuildReport& report, const Progress& progress) {
    model.barrier_options = options.barriers;
    require_paired_bounds(model);
    if (options.separate_faults) {
        model.barrier_options.spacing = separating_spacing(model.surfaces, model.domain.extent, model.frame,
                                                           model.criteria.l_min, options.barriers, progress);
    }
    const BarrierOptions& barriers = model.barrier_options;
    const Surface* const domain = domain_surface(model);
    std::vector<Surface> surfaces = model.surfaces;
    if (domain != nullptr) {
        std::erase_if(surfaces, [](const Surface& surface) { return surface.kind == SurfaceKind::domain; });
        std::ranges::move(domain_walls(model.domain.outline, domain->name, domain->file, model.domain.extent,
                                       hull_margin(barriers, model.criteria.l_min)),
                          std::back_inserter(surfaces));
    }
    BarrierPreparation preparation = prepare_barriers(surfaces, model.domain.extent, model.frame, model.criteria.l_min,
                                                      barriers, progress, model.samples.positions);
    model.barriers = std::move(preparation.barriers);
    report.barriers = std::move(preparation.accounts);
    if (domain != nullptr) {
        require_walls(model, report.barriers);
        join_walls(*domain, report.barriers);
    }
    require_ground(model, report);
    if (!model.barriers.empty()) {
        const Box3 hull = model.domain.extent.grown(hull_margin(barriers, model.criteria.l_min));
        model.domain.hull = {model.frame.snapped(hull.lo), model.frame.snapped(hull.hi)};
    }
}

/// Throws UsageError when a name belongs to no region, or a region to two names.
void name_regions(const BuildOptions& options, Model& model) {
    model.region_names = options.region_names;
    if (model.region_names.empty()) {
        return;
    }
    const BlockFinder blocks(model.domain, model.barriers);
    std::map<std::int32_t, std::string> name_of;
    for (const RegionName& named : model.region_names) {
        const std::int32_t block = blocks.at(named.point);
        if (block < 0) {
            throw UsageError(
                "`region_names`: the point that names '" + named.name +
                "' lies in no region: it is outside the extent or the domain, above the ground, or on a fault");
        }
        const auto [other, fresh] = name_of.try_emplace(block, named.name);
        if (!fresh) {
            throw UsageError("`region_names`: '" + other->second + "' and '" + named.name + "' name the same region");
        }
    }
}

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
        for (const Vec3& p : face_grid(model_.domain.hull, model_.criteria.l_min, model_.criteria.l_max, obstacles,
                                       model_.frame, poll)) {
            add(p, Role::domain, -1, 0);
        }
    }

  private:
    Model& model_;
    std::unordered_set<Vec3, PositionHash> taken_;
};

/// Values of the initial vertices: a sample's own (V1), the estimator's elsewhere and where a sample lacks a property.
void assign_values(Model& model, const ValueSource& source) {
    std::vector<ValueQuery> queries;
    for (const Vertex& vertex : model.vertices) {
        queries.push_back({vertex.position, vertex.role == Role::seed ? vertex.owner : -1, vertex.side});
    }
    ValueBatch batch = source(queries);
    for (std::size_t i = 0; i < model.vertices.size(); ++i) {
        if (model.vertices[i].role != Role::sample) {
            continue;
        }
        bool complete = true;
        for (std::size_t property = 0; property < model.properties.size(); ++property) {
            const double measured = model.samples.values[property][static_cast<std::size_t>(model.vertices[i].owner)];
            complete = complete && !std::isnan(measured);
            if (!std::isnan(measured)) {
                batch.values[property][i] = measured;
            }
        }
        if (complete) {
            batch.extrapolation[i] = 0;
        }
    }
    model.vertex_values = {std::move(batch.values), std::move(batch.extrapolation)};
}

CellStatistics initial_statistics(const TessellatedModel& built) {
    const TetMesh mesh = built.tessellation->mesh();
    return cell_statistics(built.model, mesh, measure_cells(built.model, mesh, *built.barriers), *built.barriers);
}

/// Of all that was refined: the tables that stay, and what the report says of them.
void describe(TessellatedModel& built, BuildReport& report) {
    built.mesh = built.tessellation->mesh();
    built.cells = describe_cells(built.model, built.mesh, *built.barriers);
    for (const Reason reason : built.cells.reason) {
        if (reason != Reason::none && reason != Reason::fault_gap) {
            ++report.refine.skipped[reason];
        }
    }
    report.fault_crossing_edges = fault_crossing_edges(built.model, built.mesh, *built.barriers).size();
    report.fidelity = fidelity(built.model, built.mesh, built.cells.barrier, *built.barriers);
    report.empty_blocks = empty_blocks(built.model, built.mesh, built.cells);
    report.final = cell_statistics(built.model, built.mesh, built.cells, *built.barriers);
}

}  // namespace

std::unique_ptr<TessellatedModel> build(Site site, const BuildOptions& options, const ValueSourceFactory& factory,
                                        BuildReport& report, const Progress& progress) {
    auto built = std::make_unique<TessellatedModel>();
    Model& model = built->model;
    canonicalise(site, report);
    static_cast<Site&>(model) = std::move(site);
    resolve_resolution(options, model, report);
    require_affordable(model, options);
    model.density = options.density;
    model.estimator = options.estimator;
    {
        const Stopwatch watch(report.seconds["boundary"]);
        prepare_boundary(options, model, report, progress);
        name_regions(options, model);
    }
    built->barriers = model_proximity(model);
    const BarrierQuery& proximity = *built->barriers;
    InitialVertices initial(model);
    {
        const Stopwatch watch(report.seconds["density"]);
        const Poll thinning = [&] { report_progress(progress, "density", 0); };
        thinning();
        report.density = thin(model, inside_extent(model, report), options.density, proximity, thinning);
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
    double estimating = 0;
    {
        const Stopwatch watch(estimating);
        report_progress(progress, "estimate", 0);
        source = factory(model, proximity);
        assign_values(model, source);
    }
    const ValueSource timed_source = [&](std::span<const ValueQuery> queries) {
        const Stopwatch watch(estimating);
        return source(queries);
    };
    Tessellation& tessellation = built->tessellation.emplace();
    {
        const Stopwatch watch(report.seconds["refine"]);
        tessellation.insert(model.vertices, [&] { report_progress(progress, "tessellate", 0); });
        report.initial = initial_statistics(*built);
        if (options.refine_enabled) {
            RefineOptions refine_options = options.refine;
            refine_options.progress = progress;
            const double before = estimating;
            report.refine = refine(tessellation, model.vertex_values, model.domain, model.frame, proximity,
                                   model.criteria, model.properties, timed_source, refine_options);
            report.seconds["refine"] -= estimating - before;
        }
        model.vertices.assign(tessellation.vertices().begin(), tessellation.vertices().end());
        describe(*built, report);
    }
    report.seconds["estimate"] = estimating;
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
    return options;
}

}  // namespace terratet
