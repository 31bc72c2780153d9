// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/prepare/preparer.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

#include "tess/barrier/complex/clip_sheet.hpp"
#include "tess/barrier/complex/margin.hpp"
#include "tess/barrier/complex/margin_row.hpp"
#include "tess/barrier/complex/measure_sheet.hpp"
#include "tess/barrier/complex/places_near.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

constexpr double row_clearance = 0.6;  ///< in edge lengths: a margin row keeps that far from other surfaces

bool crosses_itself(const TriMesh& mesh) {
    const SheetComplex alone{mesh.points, mesh.triangles, std::vector<std::uint32_t>(mesh.triangles.size(), 0)};
    return !crossing_triangles(alone).empty();
}

constexpr const char* enough = ", and too many others do not get along to try what would";

/// Points at equal places become one.
void weld(TriMesh& mesh) {
    std::map<Vec3, std::uint32_t> first;
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& v : t) {
            v = first.try_emplace(mesh.points[v], v).first->second;
        }
    }
    compact(mesh);
}

Surface surface_of(const TriMesh& mesh, const Surface& source, const Frame& frame) {
    Surface result{source.name, source.kind, mesh.points, mesh.triangles, source.file};
    for (Vec3& p : result.vertices) {
        p = frame.snapped(p);
    }
    return result;
}

}  // namespace

BarrierPreparer::BarrierPreparer(const std::vector<Surface>& surfaces, const Box3& extent, const Frame& frame,
                                 const BarrierScale& scale, const BarrierOptions& options, const Progress& progress,
                                 std::span<const Vec3> samples)
    : surfaces_(surfaces),
      extent_(extent),
      limit_(extent.grown(scale.reach)),
      frame_(frame),
      scale_(scale),
      options_(options),
      progress_(progress),
      samples_(samples) {}

BarrierPreparation BarrierPreparer::run() {
    repair();
    refuse_alternatives();
    check_budget();
    for (std::uint32_t k = 0; k < candidates_.size(); ++k) {
        extend(k);
    }
    cut();
    BarrierPreparation result;
    while (std::ranges::any_of(candidates_, &Candidate::active)) {
        if (std::optional<Pass> pass = attempt(); pass && seal(*pass)) {
            finish(*pass, result);
            break;
        }
    }
    for (Candidate& candidate : candidates_) {
        result.accounts.push_back(std::move(candidate.account));
    }
    return result;
}

Poll BarrierPreparer::told(std::string_view stage, double fraction) const {
    return [this, stage, fraction] { report_progress(progress_, stage, fraction); };
}

std::string BarrierPreparer::text_of(const Vec3& place) const {
    const Vec3 p = frame_.to_world(place);
    std::array<char, 96> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "(%.1f, %.1f, %.1f)", p.x, p.y, p.z);
    return buffer.data();
}

void BarrierPreparer::refuse(Candidate& candidate, const std::string& reason) {
    candidate.active = false;
    candidate.account.reason = reason;
    candidate.account.area_refused = candidate.area_inside;
}

std::string BarrierPreparer::described(const Candidate& candidate) {
    return std::string(to_string(candidate.surface->kind)) + " '" + candidate.surface->name + "'";
}

/// A rim that wavers may not be continued beyond its face, or not as far as to it: then it ends where it ended.
void BarrierPreparer::extend(std::uint32_t number) {
    Candidate& candidate = candidates_[number];
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const bool wall = candidate.surface->kind == SurfaceKind::domain;  // ends at the next one, however near a face
    for (const TriMesh& part : candidate.active ? candidate.repaired.parts : std::vector<TriMesh>{}) {
        for (const double snap : {wall ? 0.0 : scale_.spacing, 0.0, -infinity}) {
            TriMesh extended = extended_across(part, extent_, snap, scale_.reach, scale_.spacing);
            const bool last = snap == -infinity;
            if (last || !crosses_itself(extended)) {
                if (last) {
                    candidate.account.reason =
                        "rims near the extent's faces end where they ended: extending them would fold the surface";
                }
                if (!extended.triangles.empty()) {
                    candidate.sheets.push_back({std::move(extended), number});
                }
                break;
            }
        }
    }
}

/// Once for all attempts: what is refused later leaves no more than points on the others.
void BarrierPreparer::cut() {
    do {
        const Poll cutting = told("cutting faults", 0);
        std::vector<Sheet> sheets;
        for (const Candidate& candidate : candidates_) {
            if (candidate.active) {
                sheets.insert(sheets.end(), candidate.sheets.begin(), candidate.sheets.end());
            }
        }
        const std::vector<Sheet> before = sheets;
        extend_to_neighbours(sheets, scale_.snap, cutting);
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            if (candidates_[sheets[i].surface].surface->kind == SurfaceKind::domain) {
                sheets[i] = before[i];  // walls end on each other as they are
            }
        }
        cut_ = cut_sheets(sheets, static_cast<std::uint32_t>(candidates_.size()), scale_.snap, cutting);
        if (cut_.tangled) {
            refuse(candidates_[*cut_.tangled],
                   "is a tangle: its triangles meet those of its other parts and of other "
                   "faults all over");
        }
    } while (cut_.tangled);
    std::vector<char> bounds;
    for (const Candidate& candidate : candidates_) {
        bounds.push_back(is_bound(candidate.surface->kind) ? 1 : 0);
    }
    mesher_ = std::make_unique<SheetMesher>(std::move(cut_.complex), scale_.spacing, options_.mode, std::move(bounds));
    if (options_.refine) {
        mesher_->want(places_near(samples_, mesher_->cut(), scale_.spacing));
    }
}

/// Of each pair the one goes that is no bound, or the smaller, unless the other went already.
bool BarrierPreparer::refuse_failed(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs,
                                    const std::string& what) {
    const auto weight = [](const Candidate& candidate) {
        return std::pair(is_bound(candidate.surface->kind), candidate.area_inside);
    };
    bool any = false;
    for (const auto& [a, b] : pairs) {
        if (!candidates_[a].active || !candidates_[b].active) {
            continue;
        }
        if (a == b) {
            refuse(candidates_[a], "meets itself where its parts touch: no sheet can be made of it");
        } else {
            const bool first_stays = weight(candidates_[a]) >= weight(candidates_[b]);
            const std::uint32_t goes = first_stays ? b : a;
            const std::uint32_t stays = first_stays ? a : b;
            refuse(candidates_[goes], what + described(candidates_[stays]));
            if (hurries() && !is_bound(candidates_[stays].surface->kind)) {
                refuse(candidates_[stays], what + described(candidates_[goes]) + enough);
            }
        }
        any = true;
    }
    return any;
}

void BarrierPreparer::seed(Pass& pass, const SizeField& sizes, const Poll& poll, bool mend) const {
    const Box3* within = mend ? &extent_ : nullptr;
    const EdgeTable edges(pass.complex.triangles);
    const SheetWall wall(pass.complex);
    const auto count = static_cast<std::uint32_t>(candidates_.size());
    std::vector<char> bounds;
    for (const Candidate& candidate : candidates_) {
        bounds.push_back(is_bound(candidate.surface->kind) ? 1 : 0);
    }
    if (options_.mode == SeedMode::paired) {
        pass.skirts = skirts(pass.complex, edges);
        pass.seeded = paired_seeds(
            {pass.complex, wall, edges, sizes, frame_, count, scale_.width, {}, poll, within, bounds}, pass.skirts);
    } else {
        const SheetComplex whole_complex =
            with_margin_row(pass.complex, edges, wall, row_clearance, extent_, scale_.margin, frame_);
        const EdgeTable all_edges(whole_complex.triangles);
        pass.seeded = exact_seeds(
            {whole_complex, wall, all_edges, sizes, frame_, count, scale_.width, relaxed_, poll, within, bounds});
        pass.skirts.assign(count, TriMesh{whole_complex.points, {}});
        for (std::size_t t = pass.complex.triangles.size(); t < whole_complex.triangles.size(); ++t) {
            pass.skirts[whole_complex.sheet[t]].triangles.push_back(whole_complex.triangles[t]);
        }
        std::ranges::for_each(pass.skirts, [](TriMesh& mesh) { compact(mesh); });
    }
    pass.finest.assign(candidates_.size(), scale_.spacing);
    for (std::uint32_t t = 0; t < pass.complex.triangles.size(); ++t) {
        double& finest = pass.finest[pass.complex.sheet[t]];
        finest = std::min(finest, sizes.at(centroid(corners(pass.complex, t))));
    }
}

std::vector<TriMesh> BarrierPreparer::skirts(const SheetComplex& complex, const EdgeTable& edges) const {
    std::vector<TriMesh> sheets(candidates_.size());
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        sheets[complex.sheet[t]].triangles.push_back(complex.triangles[t]);
    }
    std::vector<TriMesh> result;
    for (TriMesh& sheet : sheets) {
        if (sheet.triangles.empty()) {
            result.emplace_back();
            continue;
        }
        sheet.points = complex.points;
        std::vector<RimEdge> rim = rim_edges(sheet);
        std::erase_if(rim, [&](const RimEdge& e) { return edges.triangles(e.from, e.to).size() > 1; });
        result.push_back(skirt(sheet, rim, scale_.margin, extent_, limit_));
    }
    return result;
}

void BarrierPreparer::finish(const Pass& pass, BarrierPreparation& result) {
    std::uint64_t seeds = 0;
    for (const auto& of_barrier : pass.seeded.seeds) {
        seeds += of_barrier.size();
    }
    if (seeds > options_.max_seeds) {
        throw Error("the faults need " + std::to_string(seeds) + " seeds, and max_seeds allows " +
                    std::to_string(options_.max_seeds) + ": raise `barriers.spacing`, or leave faults out");
    }
    for (std::uint32_t k = 0; k < candidates_.size(); ++k) {
        if (candidates_[k].active) {
            collect(pass, k, result);
        }
    }
}

/// Without triangles when none of it is left within the extent.
BarrierPreparer::Piece BarrierPreparer::piece_of(const Pass& pass, std::uint32_t number) const {
    TriMesh certified{pass.complex.points, {}};
    TriMesh uncertified{pass.complex.points, {}};
    for (std::uint32_t t = 0; t < pass.complex.triangles.size(); ++t) {
        if (pass.complex.sheet[t] == number) {
            (pass.seeded.certified[t] != 0 ? certified : uncertified).triangles.push_back(pass.complex.triangles[t]);
        }
    }
    compact(certified);
    compact(uncertified);
    BoxCut sure = cut_to_box(std::move(certified), extent_);
    const BoxCut rest = cut_to_box(std::move(uncertified), extent_);
    TriMesh sheet = std::move(sure.inside);
    Piece piece;
    piece.certified.assign(sheet.triangles.size(), 1);
    append(sheet, rest.inside);
    piece.certified.resize(sheet.triangles.size(), 0);
    weld(sheet);
    TriMesh margin = std::move(sure.outside);
    append(margin, rest.outside);
    weld(margin);
    append(margin, pass.skirts[number]);
    const Candidate& candidate = candidates_[number];
    Barrier& barrier = piece.barrier;
    barrier.name = candidate.surface->name;
    barrier.spacing = scale_.spacing;
    barrier.width = scale_.width;
    barrier.sheet = surface_of(sheet, *candidate.surface, frame_);
    barrier.margin = surface_of(margin, *candidate.surface, frame_);
    barrier.seeds = pass.seeded.seeds[number];
    barrier.covering_radius = pass.seeded.covering_radius[number];
    barrier.protection_radius = pass.seeded.protection_radius[number];
    barrier.refined = options_.refine;
    return piece;
}

void BarrierPreparer::collect(const Pass& pass, std::uint32_t number, BarrierPreparation& result) {
    Candidate& candidate = candidates_[number];
    BarrierAccount& account = candidate.account;
    account.finest_spacing = pass.finest[number];
    for (std::uint32_t t = 0; t < pass.complex.triangles.size(); ++t) {
        if (pass.complex.sheet[t] == number) {
            account.certified += pass.seeded.certified[t] != 0 ? 1 : 0;
            account.unseparated += pass.seeded.separated[t] == 0 ? 1 : 0;
            ++account.triangles;
        }
    }
    Piece piece = piece_of(pass, number);
    if (piece.barrier.sheet.triangles.empty()) {
        account.reason = "nothing of it is left within the extent";
        account.area_trimmed = candidate.area_inside;
        return;
    }
    account.used = true;
    account.seeds = piece.barrier.seeds.size();
    account.area_trimmed = std::min(candidate.area_inside, candidate.area_dropped + pass.trimmed[number]);
    account.area_used = candidate.area_inside - account.area_trimmed;
    TriMesh read;
    for (const Sheet& as_read : candidate.sheets) {  // with what was added at the extent's faces
        append(read, as_read.mesh);
    }
    const Deviation measured = deviation(read, {piece.barrier.sheet.vertices, piece.barrier.sheet.triangles}, extent_);
    account.deviation_median = measured.median;
    account.deviation_p95 = measured.p95;
    account.deviation_max = measured.max;
    result.barriers.push_back(std::move(piece.barrier));
    result.certified.push_back(std::move(piece.certified));
}

}  // namespace terratet
