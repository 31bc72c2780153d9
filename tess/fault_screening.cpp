// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// FaultPreparer's first steps: what is taken from the surfaces as read.
#include <algorithm>
#include <numeric>
#include <tuple>

#include "tess/error.hpp"
#include "tess/fault_clip.hpp"
#include "tess/fault_measure.hpp"
#include "tess/fault_preparation.hpp"

namespace terratet {
namespace {

constexpr double tangle_limit = 5;    ///< area over that of the extent's faces: no surface is folded so often
constexpr double most_dropped = 0.5;  ///< share of a fault that may be lost in repair
constexpr double crumb = 0.5;         ///< in spacings: smaller parts go
constexpr double alternative = 0.6;   ///< share of a fault that may run alongside another; in spacings, how near

double area_of_faces(const Box3& box) {
    const Vec3 size = box.size();
    return 2 * (size.x * size.y + size.y * size.z + size.z * size.x);
}

FaultMesh whole(const RepairedFault& repaired) {
    FaultMesh mesh;
    for (const FaultMesh& part : repaired.parts) {
        append(mesh, part);
    }
    return mesh;
}

double area_within(const RepairedFault& repaired, const Box3& extent) {
    double sum = 0;
    for (const FaultMesh& part : repaired.parts) {
        sum += area(cut_to_box(part, extent).inside);
    }
    return sum;
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

void FaultPreparer::repair() {
    double done = 0;
    for (const Surface& surface : surfaces_) {
        report_progress(progress_, "repairing faults", done++ / static_cast<double>(surfaces_.size()));
        Candidate candidate;
        candidate.surface = &surface;
        candidate.repaired = repair_fault(surface, 1e-9 * std::max(extent_.diagonal(), 1e-3));
        screen(candidate);
        candidates_.push_back(std::move(candidate));
    }
    std::ranges::stable_sort(candidates_, [](const Candidate& a, const Candidate& b) {
        return std::tie(a.surface->name, a.surface->file, a.account.area_in, a.surface->vertices,
                        a.surface->triangles) <
               std::tie(b.surface->name, b.surface->file, b.account.area_in, b.surface->vertices, b.surface->triangles);
    });
}

void FaultPreparer::screen(Candidate& candidate) {
    FaultAccount& account = candidate.account;
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
void FaultPreparer::drop_crumbs(std::vector<FaultMesh>& parts) const {
    std::erase_if(parts,
                  [&](const FaultMesh& part) { return bounding_box(part.points).diagonal() < crumb * scale_.spacing; });
}

/// Parts that run alongside a larger one of the same surface.
void FaultPreparer::drop_doubles(std::vector<FaultMesh>& parts) const {
    std::ranges::stable_sort(parts, std::greater{}, [](const FaultMesh& part) { return area(part); });
    for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
        const Alongside test(parts[i]);
        const auto doubles =
            std::remove_if(parts.begin() + static_cast<std::ptrdiff_t>(i) + 1, parts.end(), [&](const FaultMesh& part) {
                return test.share_of(part, extent_, alternative * scale_.spacing) > alternative;
            });
        parts.erase(doubles, parts.end());
    }
}

/// The largest first, bounds before all; one that mostly runs alongside another is a second version of it, unless it is
/// a wall of the domain, which is as near to the next one as the outline has it.
void FaultPreparer::refuse_alternatives() {
    std::vector<std::size_t> order(candidates_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t k) {
        return std::pair(is_bound(candidates_[k].surface->kind), candidates_[k].area_inside);
    });
    std::vector<FaultMesh> meshes;
    for (const Candidate& candidate : candidates_) {
        meshes.push_back(candidate.active ? whole(candidate.repaired) : FaultMesh{});
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        const Candidate& larger = candidates_[order[i]];
        if (!larger.active) {
            continue;
        }
        const Alongside test(meshes[order[i]]);
        for (std::size_t j = i + 1; j < order.size(); ++j) {
            Candidate& smaller = candidates_[order[j]];
            if (smaller.active && smaller.surface->kind != SurfaceKind::domain &&
                test.share_of(meshes[order[j]], extent_, alternative * scale_.spacing) > alternative) {
                refuse(smaller, "overlaps " + described(larger) + advice_on_overlap(larger.surface->kind));
            }
        }
    }
}

void FaultPreparer::check_budget() const {
    const double per_area = (options_.mode == FaultMode::exact ? 4.7 : 2.4) / (scale_.spacing * scale_.spacing);
    double seeds = 0;
    const Candidate* largest = nullptr;
    for (const Candidate& candidate : candidates_) {
        if (candidate.active) {
            seeds += per_area * candidate.area_inside;
            largest = largest == nullptr || candidate.area_inside > largest->area_inside ? &candidate : largest;
        }
    }
    if (seeds > static_cast<double>(options_.max_seeds)) {
        throw Error("the faults need about " + short_text(seeds) + " seeds, most of them '" + largest->account.name +
                    "', and max_seeds allows " + std::to_string(options_.max_seeds) +
                    ": raise --fault-spacing, or leave faults out");
    }
}

}  // namespace terratet
