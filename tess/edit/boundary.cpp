// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/edit/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "tess/barrier/prepare/prepare.hpp"
#include "tess/base/box_clip.hpp"
#include "tess/edit/build_defaults.hpp"
#include "tess/error.hpp"
#include "tess/model/block_finder.hpp"

namespace terratet {
namespace {

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

}  // namespace

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

}  // namespace terratet
