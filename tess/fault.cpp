// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fault.hpp"

#include <algorithm>
#include <cstdio>
#include <new>
#include <numbers>
#include <set>
#include <tuple>

#include "tess/error.hpp"
#include "tess/fault_clip.hpp"
#include "tess/fault_margin.hpp"
#include "tess/fault_remesh.hpp"
#include "tess/fault_repair.hpp"
#include "tess/fault_seed.hpp"
#include "tess/fault_trim.hpp"

namespace terratet {
namespace {

constexpr double bend_factor = 1.1;     ///< on the protection radius of bent surfaces
constexpr double margin_factor = 1.15;  ///< width of the margin in protection radii
constexpr double trim_limit = 0.6;      ///< share of a fault that may be trimmed beside others
constexpr double max_deviation = 0.5;   ///< of a remeshed and rounded fault from the one read, in spacings
constexpr double tangle_limit = 5;      ///< area over that of the extent's faces: no surface is folded so often
constexpr int halvings = 3;             ///< of the spacing, where the sides could not be separated

std::string text(double value) {
    std::array<char, 32> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.6g", value);
    return buffer.data();
}

std::string text(const Vec3& p) {
    std::array<char, 96> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "(%.1f, %.1f, %.1f)", p.x, p.y, p.z);
    return buffer.data();
}

/// Every length that follows from the spacing s.
struct FaultScale {
    double spacing;
    double width;
    double protection;  ///< the largest the protection radius can be
    double margin;      ///< width of the margin
    double reach;       ///< how far surfaces go on beyond the extent
    double snap;

    FaultScale(const FaultOptions& options, double requested, double fraction)
        : spacing(requested * fraction),
          width((options.width > 0 ? options.width : requested / 4) * fraction),
          protection(bend_factor * std::sqrt(0.5 * spacing * spacing + 0.25 * width * width)),
          margin(margin_factor * protection),
          reach(protection + spacing),
          snap(options.snap > 0 ? options.snap : requested) {}
};

double requested_spacing(const FaultOptions& options, double l_min) {
    return options.spacing > 0 ? options.spacing : l_min;
}

void validate(const FaultOptions& options, double l_min) {
    const double spacing = requested_spacing(options, l_min);
    for (const double length : {options.spacing, options.width, options.snap}) {
        if (!(length >= 0) || !std::isfinite(length)) {
            throw UsageError("fault spacing, width and snap must be positive lengths, or 0 for their defaults");
        }
    }
    if (!(options.width <= spacing)) {
        throw UsageError(
            "fault width " + text(options.width) + " exceeds the fault spacing " + text(spacing) +
            ": the seeds of a pair must be nearer to each other than to the next pair; lower --fault-width");
    }
}

double area_of_faces(const Box3& box) {
    const Vec3 size = box.size();
    return 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

/// A surface on its way.
struct Candidate {
    const Surface* surface = nullptr;
    RepairedFault repaired;
    double area_inside = 0;
    FaultAccount account;
};

/// One try at one spacing: a fault, or why not.
struct Attempt {
    Fault fault;
    std::string refusal;  ///< empty: it worked
    bool finer_may_help = false;
    std::size_t seeds_needed = 0;  ///< above the budget; 0: within
    double trimmed_share = 0;
    std::string trimmed_by;
    double deviation = 0;
    double steepest = 0;  ///< bend before rounding (Rounding)
    bool rims_left = false;
};

Surface surface_of(const FaultMesh& mesh, const Surface& source, const Frame& frame) {
    Surface result{source.name, SurfaceKind::fault, mesh.points, mesh.triangles, source.file};
    for (Vec3& p : result.vertices) {
        p = frame.snapped(p);
    }
    return result;
}

/// Vertices of the remeshed surface that survived all cuts, those in the extent first.
std::vector<BasePoint> surviving_vertices(const FaultMesh& remeshed_fault, const TrimmedFault& trimmed,
                                          const Box3& extent) {
    std::set<Vec3> present(trimmed.sheet.points.begin(), trimmed.sheet.points.end());
    present.insert(trimmed.margin.points.begin(), trimmed.margin.points.end());
    const std::vector<Vec3> normals = vertex_normals(remeshed_fault);
    std::vector<BasePoint> result;
    for (const bool inside : {true, false}) {
        for (std::size_t v = 0; v < normals.size(); ++v) {
            const Vec3& p = remeshed_fault.points[v];
            if (extent.contains(p) == inside && normals[v] != Vec3{} && present.contains(p)) {
                result.push_back({p, normals[v]});
            }
        }
    }
    return result;
}

/// Mirrored pairs; false when two seeds coincide.
bool place_seeds(const std::vector<BasePoint>& base, double width, const Frame& frame, std::vector<Seed>& seeds) {
    std::set<Vec3> places;
    for (const BasePoint& b : base) {
        for (const int side : {1, -1}) {
            seeds.push_back(
                {frame.snapped(b.position + 0.5 * side * width * b.normal), static_cast<std::int8_t>(side)});
            places.insert(seeds.back().position);
        }
    }
    return places.size() == seeds.size();
}

/// A connected part, out to the limit, in triangles of the spacing's size.
struct Remeshed {
    FaultMesh mesh;
    double deviation = 0;
    double steepest = 0;  ///< Rounding
    bool too_rough = false;
    bool rims_left = false;  ///< not extended to the extent's faces
    double seeds_expected = 0;
};

/// Extended across the extent's faces if that makes no bends the part does not have: a rim that wavers may not be
/// continued beyond its face, or not as far as to it; then it ends where it ended.
Remeshed remeshed_part(const FaultMesh& part, const FaultScale& scale, const Box3& extent, std::size_t seed_budget) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Remeshed result;
    FaultMesh carrier;
    for (const double snap : {scale.snap, 0.0, -infinity}) {
        FaultMesh extended = extended_across(part, extent, snap, scale.reach, scale.spacing);
        if (snap != scale.snap && extended.points == carrier.points && extended.triangles == carrier.triangles) {
            continue;  // nothing more to leave off
        }
        carrier = std::move(extended);
        result = {};
        result.seeds_expected = 2 * area(carrier) / (scale.spacing * scale.spacing);
        if (carrier.triangles.empty() || result.seeds_expected > static_cast<double>(seed_budget)) {
            break;
        }
        result.mesh = suits(carrier, scale.spacing) ? carrier : remeshed(carrier, scale.spacing);
        const Rounding rounding = round_bends(result.mesh, scale.spacing);
        result.steepest = rounding.steepest;
        result.deviation = deviation(carrier, result.mesh, extent, scale.spacing);
        result.too_rough = !rounding.resolved || result.deviation > max_deviation * scale.spacing;
        result.rims_left = snap != scale.snap;
        if (!result.too_rough) {
            break;
        }
    }
    return result;
}

/// Extends, remeshes, adds the margin, trims beside the accepted faults, seeds, and tests the separation.
Attempt attempt(const Candidate& candidate, const FaultScale& scale, const Box3& extent, const Frame& frame,
                const std::vector<Fault>& accepted, std::size_t seed_budget) {
    Attempt result;
    const Box3 limit = extent.grown(scale.reach);
    FaultMesh whole;  // remeshed, out to the limit
    FaultMesh skirts;
    for (const FaultMesh& part : candidate.repaired.parts) {
        Remeshed meshed = remeshed_part(part, scale, extent, seed_budget);
        if (meshed.seeds_expected > static_cast<double>(seed_budget)) {
            result.seeds_needed = static_cast<std::size_t>(std::min(meshed.seeds_expected, 1e15));
            result.refusal = "needs about " + text(meshed.seeds_expected) + " seeds";
            return result;
        }
        result.deviation = std::max(result.deviation, meshed.deviation);
        result.steepest = std::max(result.steepest, meshed.steepest);
        result.finer_may_help = result.finer_may_help || meshed.too_rough;
        result.rims_left = result.rims_left || meshed.rims_left;
        for (Vec3& p : meshed.mesh.points) {
            p = frame.snapped(p);
        }
        append(skirts, skirt(meshed.mesh, scale.margin, extent, limit));
        append(whole, meshed.mesh);
    }
    if (result.finer_may_help) {
        result.refusal = "is too rough for a spacing of " + text(scale.spacing) + ": rounding its bends moves it by " +
                         text(result.deviation) + " or more; choose a smaller spacing, or the exact fault mode";
        return result;
    }
    BoxCut cut = cut_to_box(whole, extent);
    FaultMesh around = std::move(cut.outside);
    append(around, skirts);
    const double area_before = area(cut.inside);
    const TrimmedFault trimmed = trim_beside(cut.inside, around, accepted, scale.protection, scale.width, scale.margin);
    result.trimmed_share = area_before > 0 ? 1 - area(trimmed.sheet) / area_before : 1;
    result.trimmed_by = trimmed.nearest;
    if (result.trimmed_share > trim_limit || trimmed.sheet.triangles.empty()) {
        result.refusal = trimmed.nearest.empty()
                             ? "nothing of it is left within the extent"
                             : "overlaps fault '" + trimmed.nearest +
                                   "': alternative versions of one fault? keep one, or use the exact fault mode";
        return result;
    }

    Fault& fault = result.fault;
    fault.name = candidate.surface->name;
    fault.spacing = scale.spacing;
    fault.width = scale.width;
    fault.sheet = surface_of(trimmed.sheet, *candidate.surface, frame);
    fault.margin = surface_of(trimmed.margin, *candidate.surface, frame);
    FaultMesh all{fault.sheet.vertices, fault.sheet.triangles};
    append(all, {fault.margin.vertices, fault.margin.triangles});
    const std::vector<BasePoint> base =
        base_points(surviving_vertices(whole, trimmed, extent), all, scale.spacing, seed_budget / 2);
    if (2 * base.size() > seed_budget) {
        result.seeds_needed = 2 * base.size();
        result.refusal = "needs more than " + std::to_string(seed_budget) + " seeds";
        return result;
    }
    const double at_most = scale.spacing * std::numbers::sqrt2 / 2 * (1 + 2e-6);
    fault.covering_radius = covering_radius(all, base, at_most);
    const Separation separation = test_separation({fault.sheet.vertices, fault.sheet.triangles}, base,
                                                  fault.covering_radius, scale.width, scale.width / 4);
    const bool distinct = place_seeds(base, scale.width, frame, fault.seeds);
    if (!separation.holds || !distinct) {
        result.refusal = "bends too sharply at " + text(frame.to_world(separation.where)) + ", even for a spacing of " +
                         text(scale.spacing) +
                         ": mirrored seeds cannot tell its sides apart there; use the exact fault mode";
        result.finer_may_help = true;
        return result;
    }
    fault.protection_radius =
        (separation.bent ? bend_factor : 1.0) *
        std::sqrt(fault.covering_radius * fault.covering_radius + 0.25 * fault.width * fault.width);
    return result;
}

/// Halves the spacing while that helps. A smooth bend is half as steep at half the spacing; a crease stays as steep,
/// and is given up after two tries instead of four, the last of which would cost 64 times the first.
Attempt prepare_one(const Candidate& candidate, const FaultOptions& options, double l_min, const Box3& extent,
                    const Frame& frame, const std::vector<Fault>& accepted, std::size_t seed_budget) {
    Attempt last;
    double last_steepest = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= halvings; ++k) {
        const FaultScale scale(options, requested_spacing(options, l_min), std::ldexp(1.0, -k));
        Attempt tried = attempt(candidate, scale, extent, frame, accepted, seed_budget);
        if (k > 0 && tried.seeds_needed > 0) {
            return last;  // what was wrong with the coarser one is the reason
        }
        if (tried.refusal.empty() || !tried.finer_may_help || tried.steepest > 0.8 * last_steepest) {
            return tried;
        }
        last_steepest = tried.steepest;
        last = std::move(tried);
    }
    return last;
}

auto canonical_key(const Candidate& c) {
    return std::tie(c.surface->name, c.surface->file, c.repaired.area);
}

bool canonical_before(const Candidate& a, const Candidate& b) {
    if (canonical_key(a) != canonical_key(b)) {
        return canonical_key(a) < canonical_key(b);
    }
    return std::tie(a.surface->vertices, a.surface->triangles) < std::tie(b.surface->vertices, b.surface->triangles);
}

std::vector<Candidate> repaired_candidates(const std::vector<Surface>& surfaces, const Box3& extent,
                                           const Progress& progress) {
    std::vector<Candidate> candidates;
    double done = 0;
    for (const Surface& surface : surfaces) {
        report_progress(progress, "repairing faults", done++ / static_cast<double>(surfaces.size()));
        if (surface.kind != SurfaceKind::fault) {
            continue;
        }
        Candidate candidate;
        candidate.surface = &surface;
        candidate.repaired = repair_fault(surface, 1e-9 * std::max(extent.diagonal(), 1e-3));
        for (const FaultMesh& part : candidate.repaired.parts) {
            candidate.area_inside += area(cut_to_box(part, extent).inside);
        }
        FaultAccount& account = candidate.account;
        account.name = surface.name;
        account.file = surface.file;
        account.parts = candidate.repaired.parts.size();
        account.dropped_triangles = candidate.repaired.dropped;
        account.area_in = candidate.repaired.area;
        account.area_outside = std::max(0.0, account.area_in - candidate.area_inside);
        candidates.push_back(std::move(candidate));
    }
    std::stable_sort(candidates.begin(), candidates.end(), canonical_before);
    return candidates;
}

void settle(FaultAccount& account, double area_inside, const Attempt& outcome) {
    if (!outcome.refusal.empty()) {
        account.reason = outcome.refusal;
        account.area_refused = area_inside;
        return;
    }
    account.used = true;
    account.seeds = outcome.fault.seeds.size();
    account.deviation_max = outcome.deviation;
    account.area_trimmed = outcome.trimmed_share * area_inside;
    account.area_used = area_inside - account.area_trimmed;
    if (!outcome.trimmed_by.empty()) {
        account.reason = "trimmed beside fault '" + outcome.trimmed_by + "'";
    }
    if (outcome.rims_left) {
        account.reason += std::string(account.reason.empty() ? "" : "; ") +
                          "rims near the extent's faces end where they ended: extending them would fold the surface";
    }
}

}  // namespace

double hull_margin(const FaultOptions& options, double l_min) {
    const FaultScale scale(options, requested_spacing(options, l_min), 1);
    return scale.reach + scale.spacing;
}

FaultPreparation prepare_faults(const std::vector<Surface>& surfaces, const Box3& extent, const Frame& frame,
                                double l_min, const FaultOptions& options, const Progress& progress) {
    validate(options, l_min);
    std::vector<Candidate> candidates = repaired_candidates(surfaces, extent, progress);
    std::vector<std::size_t> order(candidates.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = i;
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return candidates[a].area_inside > candidates[b].area_inside; });

    FaultPreparation result;
    std::vector<std::pair<std::size_t, std::size_t>> place_of;  // canonical place of candidates, of accepted faults
    std::size_t seeds = 0;
    double done = 0;
    for (const std::size_t i : order) {
        report_progress(progress, "preparing faults", done++ / static_cast<double>(order.size()));
        Candidate& candidate = candidates[i];
        if (candidate.account.area_in <= 0) {
            candidate.account.reason = "has no triangle with an area";
            continue;
        }
        if (candidate.area_inside <= 1e-12 * candidate.account.area_in) {
            candidate.account.area_outside = candidate.account.area_in;
            candidate.account.reason = "lies wholly outside the extent";
            continue;
        }
        if (candidate.area_inside > tangle_limit * area_of_faces(extent)) {
            candidate.account.area_refused = candidate.area_inside;
            candidate.account.reason = "is no surface but a tangle of triangles: within the extent its area is " +
                                       text(candidate.area_inside / area_of_faces(extent)) +
                                       " times that of the extent's faces; check the order of its corners";
            continue;
        }
        Attempt outcome;
        try {
            outcome = prepare_one(candidate, options, l_min, extent, frame, result.faults, options.max_seeds - seeds);
        } catch (const Error&) {
            throw;
        } catch (const std::bad_alloc&) {
            throw;
        } catch (const std::exception& error) {  // CGAL's assertions
            outcome = {};
            outcome.refusal = std::string("cannot be triangulated: ") + error.what();
        }
        if (outcome.seeds_needed > 0) {
            throw Error("fault '" + candidate.account.name + "' " + outcome.refusal + ", more than the " +
                        std::to_string(options.max_seeds - seeds) +
                        " that are left of max_seeds: raise --fault-spacing, or leave the fault out");
        }
        settle(candidate.account, candidate.area_inside, outcome);
        if (outcome.refusal.empty()) {
            seeds += outcome.fault.seeds.size();
            place_of.emplace_back(i, result.faults.size());
            result.faults.push_back(std::move(outcome.fault));
        }
    }

    std::sort(place_of.begin(), place_of.end());
    std::vector<Fault> sorted;
    for (const auto& [canonical, accepted] : place_of) {
        sorted.push_back(std::move(result.faults[accepted]));
    }
    result.faults = std::move(sorted);
    for (Candidate& candidate : candidates) {
        result.accounts.push_back(std::move(candidate.account));
    }
    return result;
}

}  // namespace terratet
