// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fault_preparation.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>
#include <tuple>

#include "tess/error.hpp"
#include "tess/fault_approach.hpp"
#include "tess/fault_clip.hpp"
#include "tess/fault_crowding.hpp"
#include "tess/fault_margin.hpp"
#include "tess/fault_measure.hpp"
#include "tess/fault_round.hpp"
#include "tess/fault_row.hpp"

namespace terratet {
namespace {

constexpr double tangle_limit = 5;     ///< area over that of the extent's faces: no surface is folded so often
constexpr double most_dropped = 0.5;   ///< share of a fault that may be lost in repair
constexpr double crumb = 0.5;          ///< in spacings: smaller parts go
constexpr double alternative = 0.6;    ///< share of a fault that may run alongside another; in spacings, how near
constexpr double unseparated = 0.05;   ///< share of a fault that may stay so in paired mode
constexpr double row_clearance = 0.6;  ///< in edge lengths: a margin row keeps that far from other surfaces
constexpr int halvings = 3;            ///< of the spacing, where the sides could not be separated
constexpr int exact_halvings = 1;      ///< against leaks in exact mode: triangles of unequal size are hard to certify

std::string place_text(const Vec3& p) {
    std::array<char, 96> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "(%.1f, %.1f, %.1f)", p.x, p.y, p.z);
    return buffer.data();
}

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

bool crosses_itself(const FaultMesh& mesh) {
    const FaultComplex alone{mesh.points, mesh.triangles, std::vector<std::uint32_t>(mesh.triangles.size(), 0)};
    return !crossing_triangles(alone).empty();
}

/// Points at equal places become one.
void weld(FaultMesh& mesh) {
    std::map<Vec3, std::uint32_t> first;
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& v : t) {
            v = first.try_emplace(mesh.points[v], v).first->second;
        }
    }
    compact(mesh);
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

Surface surface_of(const FaultMesh& mesh, const Surface& source, const Frame& frame) {
    Surface result{source.name, source.kind, mesh.points, mesh.triangles, source.file};
    for (Vec3& p : result.vertices) {
        p = frame.snapped(p);
    }
    return result;
}

}  // namespace

FaultPreparer::FaultPreparer(const std::vector<Surface>& surfaces, const Box3& extent, const Frame& frame,
                             const FaultScale& scale, const FaultOptions& options, const Progress& progress,
                             std::span<const Vec3> samples)
    : surfaces_(surfaces),
      extent_(extent),
      limit_(extent.grown(scale.reach)),
      frame_(frame),
      scale_(scale),
      options_(options),
      progress_(progress),
      samples_(samples) {}

FaultPreparation FaultPreparer::run() {
    repair();
    refuse_alternatives();
    check_budget();
    for (std::uint32_t k = 0; k < candidates_.size(); ++k) {
        extend(k);
    }
    cut();
    FaultPreparation result;
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

void FaultPreparer::refuse(Candidate& candidate, const std::string& reason) {
    candidate.active = false;
    candidate.account.reason = reason;
    candidate.account.area_refused = candidate.area_inside;
}

std::string FaultPreparer::described(const Candidate& candidate) {
    return std::string(to_string(candidate.surface->kind)) + " '" + candidate.surface->name + "'";
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

/// A rim that wavers may not be continued beyond its face, or not as far as to it: then it ends where it ended.
void FaultPreparer::extend(std::uint32_t number) {
    Candidate& candidate = candidates_[number];
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const bool wall = candidate.surface->kind == SurfaceKind::domain;  // ends at the next one, however near a face
    for (const FaultMesh& part : candidate.active ? candidate.repaired.parts : std::vector<FaultMesh>{}) {
        for (const double snap : {wall ? 0.0 : scale_.spacing, 0.0, -infinity}) {
            FaultMesh extended = extended_across(part, extent_, snap, scale_.reach, scale_.spacing);
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

std::optional<FaultPreparer::Pass> FaultPreparer::attempt() {
    std::vector<char> active;
    std::vector<char> walls;
    for (const Candidate& candidate : candidates_) {
        active.push_back(candidate.active ? 1 : 0);
        walls.push_back(candidate.surface->kind == SurfaceKind::domain ? 1 : 0);
    }
    mesher_->keep(active);
    const SizeField& sizes = mesher_->sizes();
    Pass pass;
    pass.trimmed = cut_.trimmed;
    const bool paired = options_.mode == FaultMode::paired;
    std::size_t crossings_before = std::numeric_limits<std::size_t>::max();
    for (int halving = 0;; ++halving) {
        report_progress(progress_, "meshing faults", 1 - 1 / (1 + 0.2 * passes_++));
        FaultRemesher::Result meshed = mesher_->mesh();
        const auto& crossings = meshed.crossings;
        pass.complex = std::move(meshed.complex);
        const bool last = halving == halvings || mesher_->overgrown();
        if (!crossings.empty()) {
            const bool helps = 2 * crossings.size() <= crossings_before;
            crossings_before = crossings.size();
            if (last || !helps || !mesher_->refine(crossing_places(pass.complex, crossings), halvings)) {
                refuse_crossing(pass.complex, crossings);
                return {};
            }
            continue;
        }
        if (paired) {
            FaultComplex rounded = pass.complex;
            std::vector<FinerPlace> bends;
            for (const Vec3& p : round_bends(rounded, sizes)) {
                bends.push_back({p, {}});
            }
            if (!last && mesher_->refine(bends, halvings)) {
                continue;
            }
            if (crossing_triangles(rounded).empty()) {
                pass.complex = std::move(rounded);
            }
        }
        halve_corners(pass.complex, walls);
        for (Vec3& p : pass.complex.points) {
            p = frame_.snapped(p);
        }
        report_progress(progress_, "seeding faults", 1 - 1 / (1 + 0.2 * passes_));
        seed(pass, sizes);
        if (!last && mesher_->refine(crowded_places(pass.complex, pass.seeded.seeds, sizes, walls),
                                     paired ? halvings : exact_halvings)) {
            continue;
        }
        if (!paired) {
            return pass;
        }
        const std::vector<char> inner = inner_triangles(pass.complex, EdgeTable(pass.complex.triangles));
        std::vector<FinerPlace> places;
        std::vector<double> bad(candidates_.size(), 0);
        std::vector<Vec3> where(candidates_.size());
        for (std::uint32_t t = 0; t < inner.size(); ++t) {
            if (inner[t] != 0 && pass.seeded.separated[t] == 0) {
                const TriangleCorners c = corners(pass.complex, t);
                places.push_back(place_of(pass.complex, t));
                bad[pass.complex.sheet[t]] += length(area_vector(c));
                where[pass.complex.sheet[t]] = places.back().position;
            }
        }
        if (!last && mesher_->refine(places, halvings)) {
            continue;
        }
        bool refused = false;
        for (std::size_t k = 0; k < bad.size(); ++k) {
            if (bad[k] > unseparated * candidates_[k].area_inside) {
                refuse(candidates_[k],
                       "bends too sharply at " + place_text(frame_.to_world(where[k])) +
                           ": mirrored seeds cannot tell its sides apart there; use a finer --fault-spacing" +
                           (is_bound(candidates_[k].surface->kind) ? "" : " or the exact fault mode"));
                refused = true;
            }
        }
        if (refused) {
            return {};
        }
        return pass;
    }
}

/// Once for all attempts: what is refused later leaves no more than points on the others.
void FaultPreparer::cut() {
    do {
        report_progress(progress_, "cutting faults", 0);
        std::vector<Sheet> sheets;
        for (const Candidate& candidate : candidates_) {
            if (candidate.active) {
                sheets.insert(sheets.end(), candidate.sheets.begin(), candidate.sheets.end());
            }
        }
        const std::vector<Sheet> before = sheets;
        extend_to_neighbours(sheets, scale_.snap);
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            if (candidates_[sheets[i].surface].surface->kind == SurfaceKind::domain) {
                sheets[i] = before[i];  // walls end on each other as they are
            }
        }
        cut_ = cut_sheets(sheets, static_cast<std::uint32_t>(candidates_.size()), scale_.snap);
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
    mesher_ = std::make_unique<FaultMesher>(std::move(cut_.complex), scale_.spacing, options_.mode, std::move(bounds));
    if (options_.refine) {
        mesher_->want(places_near(samples_, mesher_->cut(), scale_.spacing));
    }
}

/// Of each pair the one goes that is no bound, or the smaller, unless the other went already.
bool FaultPreparer::refuse_failed(const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs,
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
            refuse(candidates_[first_stays ? b : a], what + described(candidates_[first_stays ? a : b]));
        }
        any = true;
    }
    return any;
}

bool FaultPreparer::refuse_crossing(const FaultComplex& complex,
                                    const std::vector<std::array<std::uint32_t, 2>>& crossings) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const auto& [s, t] : crossings) {
        const auto [a, b] = std::minmax(complex.sheet[s], complex.sheet[t]);
        pairs.emplace_back(a, b);
    }
    std::ranges::sort(pairs);
    pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
    return refuse_failed(pairs,
                         "is too rough for the spacing, or meets it at too small an angle: remeshed it still crosses ");
}

void FaultPreparer::seed(Pass& pass, const SizeField& sizes) const {
    const EdgeTable edges(pass.complex.triangles);
    const FaultWall wall(pass.complex);
    const auto count = static_cast<std::uint32_t>(candidates_.size());
    if (options_.mode == FaultMode::paired) {
        pass.skirts = skirts(pass.complex, edges);
        pass.seeded = paired_seeds({pass.complex, wall, edges, sizes, frame_, count, scale_.width}, pass.skirts);
    } else {
        const FaultComplex whole_complex =
            with_margin_row(pass.complex, edges, wall, row_clearance, extent_, scale_.margin, frame_);
        const EdgeTable all_edges(whole_complex.triangles);
        pass.seeded = exact_seeds({whole_complex, wall, all_edges, sizes, frame_, count, scale_.width, relaxed_});
        pass.skirts.assign(count, FaultMesh{whole_complex.points, {}});
        for (std::size_t t = pass.complex.triangles.size(); t < whole_complex.triangles.size(); ++t) {
            pass.skirts[whole_complex.sheet[t]].triangles.push_back(whole_complex.triangles[t]);
        }
        std::ranges::for_each(pass.skirts, [](FaultMesh& mesh) { compact(mesh); });
    }
    pass.finest.assign(candidates_.size(), scale_.spacing);
    for (std::uint32_t t = 0; t < pass.complex.triangles.size(); ++t) {
        double& finest = pass.finest[pass.complex.sheet[t]];
        finest = std::min(finest, sizes.at(centroid(corners(pass.complex, t))));
    }
}

std::vector<FaultMesh> FaultPreparer::skirts(const FaultComplex& complex, const EdgeTable& edges) const {
    std::vector<FaultMesh> sheets(candidates_.size());
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        sheets[complex.sheet[t]].triangles.push_back(complex.triangles[t]);
    }
    std::vector<FaultMesh> result;
    for (FaultMesh& sheet : sheets) {
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

FaultPreparer::Barriers FaultPreparer::barriers(const Pass& pass) const {
    Barriers result;
    for (std::uint32_t k = 0; k < candidates_.size(); ++k) {
        if (Piece piece = piece_of(pass, k); !piece.fault.sheet.triangles.empty()) {
            result.faults.push_back(std::move(piece.fault));
            result.numbers.push_back(k);
        }
    }
    return result;
}

bool FaultPreparer::seal(Pass& pass) {
    FaultSeal sealed;
    Barriers all;
    for (bool again = true; again;) {
        report_progress(progress_, "sealing faults", 0);
        all = barriers(pass);
        sealed = seal_faults(all.faults, extent_.grown(scale_.hull), frame_);
        again = relax(sealed.open);
        if (refuse_leaking(sealed.open, all.numbers)) {
            return false;
        }
        if (again) {
            seed(pass, mesher_->sizes());
        }
    }
    for (std::size_t f = 0; f < all.faults.size(); ++f) {
        pass.seeded.seeds[all.numbers[f]] = std::move(sealed.seeds[f]);
        append(pass.skirts[all.numbers[f]], sealed.flakes[f]);
    }
    constexpr double reach = 1 + 1e-6;
    for (std::uint32_t t = 0; t < pass.complex.triangles.size(); ++t) {  // their balls have to stay as they were
        if (pass.seeded.certified[t] != 0) {
            pass.seeded.certified[t] = std::ranges::none_of(pass.complex.triangles[t], [&](std::uint32_t v) {
                return std::ranges::any_of(sealed.changed, [&](const Vec3& p) {
                    return distance(p, pass.complex.points[v]) < reach * pass.seeded.radius[v];
                });
            });
        }
    }
    return true;
}

/// Gives up certificates where seeds could not be sealed, and leaves those where that did not help. Anything given up?
bool FaultPreparer::relax(std::vector<FaultSeal::Open>& open) {
    if (options_.mode == FaultMode::paired) {
        return false;
    }
    const std::size_t before = relaxed_.size();
    const auto is_relaxed = [&](const FaultSeal::Open& leak) {
        return std::any_of(relaxed_.begin(), relaxed_.begin() + static_cast<std::ptrdiff_t>(before),
                           [&](const Vec3& place) { return distance(place, leak.place) < 0.5 * scale_.spacing; });
    };
    std::erase_if(open, [&](const FaultSeal::Open& leak) {
        if (!is_relaxed(leak)) {
            relaxed_.push_back(leak.place);
            return true;
        }
        return false;
    });
    return relaxed_.size() > before;
}

/// The smaller one of the two involved goes, but never a bound: where two of these leak, their accounts say so.
bool FaultPreparer::refuse_leaking(const std::vector<FaultSeal::Open>& open,
                                   const std::vector<std::uint32_t>& numbers) {
    const auto bounds = [](const Candidate& candidate) { return is_bound(candidate.surface->kind); };
    bool any = false;
    for (const FaultSeal::Open& leak : open) {
        Candidate& crossed = candidates_[numbers[leak.fault]];
        Candidate& other = candidates_[numbers[leak.owner]];
        const std::string place = place_text(frame_.to_world(leak.place));
        if (bounds(crossed) && bounds(other)) {
            crossed.account.reason =
                "cannot be sealed at " + place + ": edges may cross it there; use a finer --fault-spacing";
        } else if (crossed.active && other.active) {
            const bool crossed_stays = bounds(crossed) || (!bounds(other) && other.area_inside < crossed.area_inside);
            refuse(crossed_stays ? other : crossed,
                   "cannot be sealed at " + place +
                       ": edges would cross it there whatever its seeds; use a finer --fault-spacing" +
                       (options_.mode == FaultMode::paired ? " or the exact fault mode" : ""));
            any = true;
        }
    }
    return any;
}

void FaultPreparer::finish(const Pass& pass, FaultPreparation& result) {
    std::uint64_t seeds = 0;
    for (const auto& of_fault : pass.seeded.seeds) {
        seeds += of_fault.size();
    }
    if (seeds > options_.max_seeds) {
        throw Error("the faults need " + std::to_string(seeds) + " seeds, and max_seeds allows " +
                    std::to_string(options_.max_seeds) + ": raise --fault-spacing, or leave faults out");
    }
    for (std::uint32_t k = 0; k < candidates_.size(); ++k) {
        if (candidates_[k].active) {
            collect(pass, k, result);
        }
    }
}

/// Without triangles when none of it is left within the extent.
FaultPreparer::Piece FaultPreparer::piece_of(const Pass& pass, std::uint32_t number) const {
    FaultMesh certified{pass.complex.points, {}};
    FaultMesh uncertified{pass.complex.points, {}};
    for (std::uint32_t t = 0; t < pass.complex.triangles.size(); ++t) {
        if (pass.complex.sheet[t] == number) {
            (pass.seeded.certified[t] != 0 ? certified : uncertified).triangles.push_back(pass.complex.triangles[t]);
        }
    }
    compact(certified);
    compact(uncertified);
    BoxCut sure = cut_to_box(std::move(certified), extent_);
    const BoxCut rest = cut_to_box(std::move(uncertified), extent_);
    FaultMesh sheet = std::move(sure.inside);
    Piece piece;
    piece.certified.assign(sheet.triangles.size(), 1);
    append(sheet, rest.inside);
    piece.certified.resize(sheet.triangles.size(), 0);
    weld(sheet);
    FaultMesh margin = std::move(sure.outside);
    append(margin, rest.outside);
    weld(margin);
    append(margin, pass.skirts[number]);
    const Candidate& candidate = candidates_[number];
    Fault& fault = piece.fault;
    fault.name = candidate.surface->name;
    fault.spacing = scale_.spacing;
    fault.width = scale_.width;
    fault.sheet = surface_of(sheet, *candidate.surface, frame_);
    fault.margin = surface_of(margin, *candidate.surface, frame_);
    fault.seeds = pass.seeded.seeds[number];
    fault.covering_radius = pass.seeded.covering_radius[number];
    fault.protection_radius = pass.seeded.protection_radius[number];
    fault.refined = options_.refine;
    return piece;
}

void FaultPreparer::collect(const Pass& pass, std::uint32_t number, FaultPreparation& result) {
    Candidate& candidate = candidates_[number];
    FaultAccount& account = candidate.account;
    account.finest_spacing = pass.finest[number];
    for (std::uint32_t t = 0; t < pass.complex.triangles.size(); ++t) {
        if (pass.complex.sheet[t] == number) {
            account.certified += pass.seeded.certified[t] != 0 ? 1 : 0;
            account.unseparated += pass.seeded.separated[t] == 0 ? 1 : 0;
            ++account.triangles;
        }
    }
    Piece piece = piece_of(pass, number);
    if (piece.fault.sheet.triangles.empty()) {
        account.reason = "nothing of it is left within the extent";
        account.area_trimmed = candidate.area_inside;
        return;
    }
    account.used = true;
    account.seeds = piece.fault.seeds.size();
    account.area_trimmed = std::min(candidate.area_inside, candidate.area_dropped + pass.trimmed[number]);
    account.area_used = candidate.area_inside - account.area_trimmed;
    FaultMesh read;
    for (const Sheet& as_read : candidate.sheets) {  // with what was added at the extent's faces
        append(read, as_read.mesh);
    }
    const Deviation measured = deviation(read, {piece.fault.sheet.vertices, piece.fault.sheet.triangles}, extent_);
    account.deviation_median = measured.median;
    account.deviation_p95 = measured.p95;
    account.deviation_max = measured.max;
    result.faults.push_back(std::move(piece.fault));
    result.certified.push_back(std::move(piece.certified));
}

}  // namespace terratet
