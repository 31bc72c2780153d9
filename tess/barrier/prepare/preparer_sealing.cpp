// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// BarrierPreparer's last step: its seeds made tight.
#include <algorithm>
#include <cmath>

#include "tess/barrier/prepare/preparer.hpp"

namespace terratet {
namespace {

constexpr int relaxations = 3;  ///< of certificates, before who cannot be sealed goes

}  // namespace

BarrierPreparer::Sealable BarrierPreparer::sealable(const Pass& pass) const {
    Sealable result;
    for (std::uint32_t k = 0; k < candidates_.size(); ++k) {
        if (Piece piece = piece_of(pass, k); !piece.barrier.sheet.triangles.empty()) {
            result.barriers.push_back(std::move(piece.barrier));
            result.numbers.push_back(k);
        }
    }
    return result;
}

bool BarrierPreparer::seal(Pass& pass) {
    Seal sealed;
    Sealable all;
    bool again = true;
    for (int round = 1; again; ++round) {
        const auto sealing = [&](double share) {
            report_progress(progress_, "sealing faults", 1 - std::pow(0.3, seals_ + share));
        };
        seed(
            pass, mesher_->sizes(), [&] { sealing(0); }, true);
        all = sealable(pass);
        if (all.barriers.empty()) {
            return true;
        }
        sealed = seal_sheets(all.barriers, extent_.grown(scale_.hull), frame_, sealing);
        ++seals_;
        again = relax(sealed.open, round);
        if (refuse_leaking(sealed.open, all.numbers)) {
            return false;
        }
    }
    for (std::size_t f = 0; f < all.barriers.size(); ++f) {
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
bool BarrierPreparer::relax(std::vector<Seal::Open>& open, int round) {
    if (options_.mode == SeedMode::paired || hurries() || round > relaxations) {
        return false;
    }
    const std::size_t before = relaxed_.size();
    const auto is_relaxed = [&](const Seal::Open& leak) {
        return std::any_of(relaxed_.begin(), relaxed_.begin() + static_cast<std::ptrdiff_t>(before),
                           [&](const Vec3& place) { return distance(place, leak.place) < 0.5 * scale_.spacing; });
    };
    std::erase_if(open, [&](const Seal::Open& leak) {
        if (!is_relaxed(leak)) {
            relaxed_.push_back(leak.place);
            return true;
        }
        return false;
    });
    return relaxed_.size() > before;
}

/// The smaller one of the two involved goes, but never a bound: where two of these leak, their accounts say so.
bool BarrierPreparer::refuse_leaking(const std::vector<Seal::Open>& open, const std::vector<std::uint32_t>& numbers) {
    const auto bounds = [](const Candidate& candidate) { return is_bound(candidate.surface->kind); };
    bool any = false;
    for (const Seal::Open& leak : open) {
        Candidate& crossed = candidates_[numbers[leak.barrier]];
        Candidate& other = candidates_[numbers[leak.owner]];
        const std::string place = text_of(leak.place);
        if (bounds(crossed) && bounds(other)) {
            crossed.account.reason =
                "cannot be sealed at " + place + ": edges may cross it there; use a finer `barriers.spacing`";
        } else if (crossed.active && other.active) {
            const bool crossed_stays = bounds(crossed) || (!bounds(other) && other.area_inside < crossed.area_inside);
            const std::string reason =
                "cannot be sealed at " + place +
                ": edges would cross it there whatever its seeds; use a finer `barriers.spacing`" +
                (options_.mode == SeedMode::paired ? " or the exact fault mode" : "");
            Candidate& stays = crossed_stays ? crossed : other;
            refuse(crossed_stays ? other : crossed, reason);
            if (hurries() && stays.active && !bounds(stays)) {
                refuse(stays, reason);
            }
            any = true;
        }
    }
    return any;
}

}  // namespace terratet
