// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BarrierPreparer's first steps: what is taken from the surfaces as read.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "tess/barrier/complex/clip_sheet.hpp"
#include "tess/barrier/complex/measure_sheet.hpp"
#include "tess/barrier/prepare/preparer.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr double tangle_limit = 5;    ///< area over that of the extent's faces: no surface is folded so often
constexpr double most_dropped = 0.5;  ///< share of a fault that may be lost in repair
constexpr double clearly = 0.8;       ///< of the spacing that just keeps two surfaces that run side by side
constexpr double affordable = 2e5;    ///< seeds that a spacing chosen for that may take
constexpr double turned_back = 0.05;  ///< share of a surface's edges at which it may turn by more than a right angle,
constexpr double crumpled = 2;        ///< if it has so many times the area that it spans,
constexpr std::size_t telling = 50;   ///< and if there are so many such edges
constexpr double crumb = 0.5;         ///< in spacings: smaller parts go
constexpr double alternative = 0.6;   ///< share of a fault that may run alongside another; in spacings, how near

double area_of_faces(const Box3& box) {
    const Vec3 size = box.size();
    return 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

TriMesh whole(const RepairedSheet& repaired) {
    TriMesh mesh;
    for (const TriMesh& part : repaired.parts) {
        append(mesh, part);
    }
    return mesh;
}

double area_within(const RepairedSheet& repaired, const Box3& extent) {
    double sum = 0;
    for (const TriMesh& part : repaired.parts) {
        sum += area(cut_to_box(part, extent).inside);
    }
    return sum;
}

/// How crumpled a surface is. One through points that are no graph over their best-fit plane turns back on itself all
/// over; a closed one, a folded one, or one with needles does not.
struct Crumple {
    std::size_t edges = 0;
    std::size_t turned = 0;  ///< of these: by more than a right angle
    double area = 0;
    Vec3 spanned;

    explicit Crumple(const std::vector<TriMesh>& parts) {
        for (const TriMesh& part : parts) {
            std::vector<Vec3> normals;
            for (const Triangle& t : part.triangles) {
                const Vec3 own = area_vector(corners(part, t));
                area += length(own);
                spanned = spanned + own;
                normals.push_back(own);
            }
            const EdgeTable table(part.triangles);
            for (const EdgeTable::Edge& e : table.edges()) {
                if (const auto of_edge = table.triangles(e); of_edge.size() == 2) {
                    ++edges;
                    turned += dot(normals[of_edge[0]], normals[of_edge[1]]) < 0 ? 1 : 0;
                }
            }
        }
    }
    [[nodiscard]] double share() const { return static_cast<double>(turned) / static_cast<double>(edges); }
    [[nodiscard]] double times() const { return area / length(spanned); }
    [[nodiscard]] bool is_too_much() const {
        return turned >= telling && share() > turned_back && area > crumpled * length(spanned);
    }
};

/// To two digits: what a person would type.
double rounded_down(double value) {
    const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
    return std::floor(value / unit * (1 + 1e-9)) * unit;
}

const char* advice_on_overlap(SurfaceKind with) {
    switch (with) {
        case SurfaceKind::fault:
            return ": alternative versions of one fault? keep one of them";
        case SurfaceKind::horizon:
            return ": where the two run together keep one of them, and let the other end there";
        case SurfaceKind::topography:
            return ": let it end where it comes to the ground";
        case SurfaceKind::domain:
            return ": a fault cannot be a domain's boundary; let the domain reach beyond it";
    }
    return "";
}

}  // namespace

void BarrierPreparer::repair() {
    double done = 0;
    for (const Surface& surface : surfaces_) {
        report_progress(progress_, "repairing faults", done++ / static_cast<double>(surfaces_.size()));
        Candidate candidate;
        candidate.surface = &surface;
        candidate.repaired = repair_sheet(surface, 1e-9 * std::max(extent_.diagonal(), 1e-3));
        screen(candidate);
        candidates_.push_back(std::move(candidate));
    }
    std::ranges::stable_sort(
        candidates_, [](const Candidate& a, const Candidate& b) { return canonical_before(*a.surface, *b.surface); });
}

void BarrierPreparer::screen(Candidate& candidate) {
    BarrierAccount& account = candidate.account;
    account.name = candidate.surface->name;
    account.kind = candidate.surface->kind;
    account.file = candidate.surface->file;
    account.parts = candidate.repaired.parts.size();
    account.dropped_triangles = candidate.repaired.dropped;
    account.area_in = candidate.repaired.area;
    candidate.area_inside = area_within(candidate.repaired, extent_);
    account.area_outside = std::max(0.0, account.area_in - candidate.area_inside);
    if (account.area_in <= 0) {
        refuse(candidate, "has no triangle with an area");
        return;
    }
    if (candidate.area_inside <= 1e-12 * account.area_in) {
        account.area_outside = account.area_in;
        candidate.area_inside = 0;
        refuse(candidate, "lies wholly outside the extent");
        return;
    }
    if (candidate.area_inside > tangle_limit * area_of_faces(extent_)) {
        refuse(candidate, "is no surface but a tangle of triangles: within the extent its area is " +
                              short_text(candidate.area_inside / area_of_faces(extent_)) +
                              " times that of the extent's faces; check the order of its corners");
        return;
    }
    if (const Crumple crumple(candidate.repaired.parts); crumple.is_too_much()) {
        refuse(candidate, "is no surface but a tangle: at " + short_text(std::round(100 * crumple.share())) +
                              " % of its edges it turns back on itself, and it has " + short_text(crumple.times()) +
                              " times the area that it spans; points make one only where in their best-fit plane no "
                              "two parts of it lie over each other");
        return;
    }
    drop_self_crossings(candidate.repaired);
    drop_crumbs(candidate.repaired.parts);
    if (candidate.repaired.parts.empty()) {
        refuse(candidate,
               "is in pieces, none of which is as large as half the fault spacing " + short_text(scale_.spacing));
        return;
    }
    drop_doubles(candidate.repaired.parts);
    const double left = area_within(candidate.repaired, extent_);
    candidate.area_dropped = std::max(0.0, candidate.area_inside - left);
    if (left < (1 - most_dropped) * candidate.area_inside) {
        refuse(candidate,
               "is no surface: most of it runs through itself, lies on itself, or is in pieces smaller than "
               "half the fault spacing");
    }
}

/// What the spacing cannot show.
void BarrierPreparer::drop_crumbs(std::vector<TriMesh>& parts) const {
    std::erase_if(parts,
                  [&](const TriMesh& part) { return bounding_box(part.points).diagonal() < crumb * scale_.spacing; });
}

/// Parts that run alongside a larger one of the same surface.
void BarrierPreparer::drop_doubles(std::vector<TriMesh>& parts) const {
    std::ranges::stable_sort(parts, std::greater{}, [](const TriMesh& part) { return area(part); });
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        const Alongside test(parts[i]);
        const auto doubles =
            std::remove_if(parts.begin() + static_cast<std::ptrdiff_t>(i) + 1, parts.end(), [&](const TriMesh& part) {
                return test.share_of(part, extent_, alternative * scale_.spacing) > alternative;
            });
        parts.erase(doubles, parts.end());
    }
}

/// The largest first, bounds before all; one that mostly runs alongside another goes, unless it is a wall of the
/// domain, which is as near to the next one as the outline has it.
std::vector<BarrierPreparer::Close> BarrierPreparer::close_pairs() {
    std::vector<std::size_t> order(candidates_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t k) {
        return std::pair(is_bound(candidates_[k].surface->kind), candidates_[k].area_inside);
    });
    std::vector<TriMesh> meshes;
    std::vector<char> stays;
    for (const Candidate& candidate : candidates_) {
        meshes.push_back(candidate.active ? whole(candidate.repaired) : TriMesh{});
        stays.push_back(candidate.active ? 1 : 0);
    }
    std::vector<Close> pairs;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (stays[order[i]] == 0) {
            continue;
        }
        const Alongside test(meshes[order[i]]);
        for (const std::size_t smaller : std::span(order).subspan(i + 1)) {
            report_progress(progress_, "comparing faults", static_cast<double>(i) / static_cast<double>(order.size()));
            const double near = alternative * scale_.spacing;
            if (stays[smaller] == 0 || candidates_[smaller].surface->kind == SurfaceKind::domain ||
                !(test.share_of(meshes[smaller], extent_, near) > alternative)) {
                continue;
            }
            stays[smaller] = 0;
            Close pair{order[i], smaller};
            if (!is_bound(candidates_[order[i]].surface->kind) && !touch(meshes[order[i]], meshes[smaller])) {
                pair.apart = true;
                pair.distance = test.distance_of(meshes[smaller], extent_, alternative, near);
                pair.spacing = rounded_down(clearly * pair.distance / alternative);
            }
            pairs.push_back(pair);
        }
    }
    return pairs;
}

std::string BarrierPreparer::reason_of(const Close& pair) const {
    const Candidate& larger = candidates_[pair.larger];
    if (!pair.apart) {
        return "overlaps " + described(larger) + advice_on_overlap(larger.surface->kind);
    }
    return "runs alongside " + described(larger) + " at a distance of " + short_text(rounded_down(pair.distance)) +
           " without meeting it, too near for the fault spacing " + short_text(scale_.spacing) +
           ": a `barriers.spacing` of " + short_text(pair.spacing) +
           " keeps both, and auto finds it; if they are versions of one fault, keep one of them";
}

void BarrierPreparer::refuse_alternatives() {
    for (const Close& pair : close_pairs()) {
        refuse(candidates_[pair.smaller], reason_of(pair));
    }
}

double BarrierPreparer::separating_spacing() {
    repair();
    std::vector<double> wanted{scale_.spacing};
    for (const Close& pair : close_pairs()) {
        if (pair.apart && seeds_at(pair.spacing) <= affordable) {
            wanted.push_back(pair.spacing);
        }
    }
    return std::max({std::ranges::min(wanted), options_.width, 2 * options_.snap});
}

double BarrierPreparer::seeds_at(double spacing) const {
    double seeds = 0;
    for (const Candidate& candidate : candidates_) {
        seeds += candidate.active ? candidate.area_inside : 0;
    }
    return seeds * (options_.mode == SeedMode::exact ? 4.7 : 2.4) / (spacing * spacing);
}

void BarrierPreparer::check_budget() const {
    const Candidate* largest = nullptr;
    for (const Candidate& candidate : candidates_) {
        if (candidate.active) {
            largest = largest == nullptr || candidate.area_inside > largest->area_inside ? &candidate : largest;
        }
    }
    if (const double seeds = seeds_at(scale_.spacing); seeds > static_cast<double>(options_.max_seeds)) {
        throw Error("the faults need about " + short_text(seeds) + " seeds, most of them '" + largest->account.name +
                    "', and max_seeds allows " + std::to_string(options_.max_seeds) +
                    ": raise `barriers.spacing`, or leave faults out");
    }
}

}  // namespace terratet
