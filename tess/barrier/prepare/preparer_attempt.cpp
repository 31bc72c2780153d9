// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One attempt of BarrierPreparer at triangles and seeds for all that is left.
#include <algorithm>

#include "tess/barrier/complex/measure_sheet.hpp"
#include "tess/barrier/complex/round_off.hpp"
#include "tess/barrier/prepare/crowding.hpp"
#include "tess/barrier/prepare/preparer.hpp"

namespace terratet {
namespace {

constexpr double unseparated = 0.05;  ///< share of a fault that may stay so in paired mode
constexpr int halvings = 3;           ///< of the spacing, where the sides could not be separated
constexpr int exact_halvings = 1;     ///< against leaks in exact mode: triangles of unequal size are hard to certify

}  // namespace

std::optional<BarrierPreparer::Pass> BarrierPreparer::attempt() {
    std::vector<char> active;
    std::vector<char> walls;
    for (const Candidate& candidate : candidates_) {
        active.push_back(candidate.active ? 1 : 0);
        walls.push_back(candidate.surface->kind == SurfaceKind::domain ? 1 : 0);
    }
    mesher_->keep(active);
    ++attempts_;
    Pass pass;
    pass.trimmed = cut_.trimmed;
    std::size_t crossings = std::numeric_limits<std::size_t>::max();
    for (int halving = 0;; ++halving) {
        SheetRemesher::Result meshed = mesher_->mesh(told("meshing faults", 1 - 1 / (1 + 0.2 * passes_++)));
        pass.complex = std::move(meshed.complex);
        const bool last = halving == halvings || mesher_->overgrown() || hurries();
        const bool helped = 2 * meshed.crossings.size() <= crossings;
        crossings = meshed.crossings.empty() ? crossings : meshed.crossings.size();
        Finding found = check_crossings(pass, meshed.crossings, last || !helped);
        if (found == Finding::good) {
            found = check_bends(pass, last);
        }
        if (found == Finding::good) {
            place_seeds(pass, walls);
            found = check_crowding(pass, walls, last);
        }
        if (found == Finding::good) {
            found = check_separation(pass, last);
        }
        if (found != Finding::finer) {
            return found == Finding::good ? std::optional(std::move(pass)) : std::nullopt;
        }
    }
}

/// Do remeshed sheets cross each other?
BarrierPreparer::Finding BarrierPreparer::check_crossings(const Pass& pass,
                                                          const std::vector<std::array<std::uint32_t, 2>>& crossings,
                                                          bool last) {
    if (crossings.empty()) {
        return Finding::good;
    }
    if (!last && mesher_->refine(crossing_places(pass.complex, crossings), halvings)) {
        return Finding::finer;
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const auto& [s, t] : crossings) {
        const auto [a, b] = std::minmax(pass.complex.sheet[s], pass.complex.sheet[t]);
        pairs.emplace_back(a, b);
    }
    std::ranges::sort(pairs);
    pairs.erase(std::ranges::unique(pairs).begin(), pairs.end());
    refuse_failed(pairs, "is too rough for the spacing, or meets it at too small an angle: remeshed it still crosses ");
    return Finding::refused;
}

/// Paired mode: are bends round enough for mirrored seeds? They are rounded off where that lets no sheets cross.
BarrierPreparer::Finding BarrierPreparer::check_bends(Pass& pass, bool last) {
    if (options_.mode != SeedMode::paired) {
        return Finding::good;
    }
    SheetComplex rounded = pass.complex;
    std::vector<FinerPlace> bends;
    for (const Vec3& p : round_bends(rounded, mesher_->sizes())) {
        bends.push_back({p, {}});
    }
    if (!last && mesher_->refine(bends, halvings)) {
        return Finding::finer;
    }
    if (crossing_triangles(rounded).empty()) {
        pass.complex = std::move(rounded);
    }
    return Finding::good;
}

void BarrierPreparer::place_seeds(Pass& pass, const std::vector<char>& walls) const {
    halve_corners(pass.complex, walls);
    for (Vec3& p : pass.complex.points) {
        p = frame_.snapped(p);
    }
    seed(pass, mesher_->sizes(), told("seeding faults", 1 - 1 / (1 + 0.2 * passes_)));
}

/// Do seeds of different sheets stand too near each other? Then only finer triangles help, or nothing does.
BarrierPreparer::Finding BarrierPreparer::check_crowding(const Pass& pass, const std::vector<char>& walls, bool last) {
    const Poll seeding = told("seeding faults", 1 - 1 / (1 + 0.2 * passes_));
    const int most = options_.mode == SeedMode::paired ? halvings : exact_halvings;
    const bool finer =
        !last &&
        mesher_->refine(crowded_places(pass.complex, pass.seeded.seeds, mesher_->sizes(), walls, seeding), most);
    return finer ? Finding::finer : Finding::good;
}

/// Paired mode: is the nearest seed on a place's own side, but for a small share of each surface?
BarrierPreparer::Finding BarrierPreparer::check_separation(const Pass& pass, bool last) {
    if (options_.mode != SeedMode::paired) {
        return Finding::good;
    }
    const std::vector<char> inner = inner_triangles(pass.complex, EdgeTable(pass.complex.triangles));
    std::vector<FinerPlace> places;
    std::vector<double> bad(candidates_.size(), 0);
    std::vector<Vec3> where(candidates_.size());
    for (std::uint32_t t = 0; t < inner.size(); ++t) {
        if (inner[t] != 0 && pass.seeded.separated[t] == 0) {
            places.push_back(place_of(pass.complex, t));
            bad[pass.complex.sheet[t]] += length(area_vector(corners(pass.complex, t)));
            where[pass.complex.sheet[t]] = places.back().position;
        }
    }
    if (!last && mesher_->refine(places, halvings)) {
        return Finding::finer;
    }
    Finding found = Finding::good;
    for (std::size_t k = 0; k < bad.size(); ++k) {
        if (bad[k] > unseparated * candidates_[k].area_inside) {
            refuse(candidates_[k],
                   "bends too sharply at " + text_of(where[k]) +
                       ": mirrored seeds cannot tell its sides apart there; use a finer `barriers.spacing`" +
                       (is_bound(candidates_[k].surface->kind) ? "" : " or the exact fault mode"));
            found = Finding::refused;
        }
    }
    return found;
}

}  // namespace terratet
