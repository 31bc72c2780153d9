// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier_query.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <set>

#include "tess/barrier/query/estimation_barriers.hpp"
#include "tess/barrier/query/protection_radii.hpp"
#include "tess/barrier/query/rim_turns.hpp"
#include "tess/base/triangle_grid.hpp"
#include "tess/base/triangle_tree.hpp"

namespace terratet {
namespace {

constexpr double least_step = 1e-9;  ///< off a barrier, over the spacing

/// What does not depend on what bars.
struct Sheets {
    explicit Sheets(std::span<const Barrier> given);

    std::span<const Barrier> barriers;
    std::vector<TriangleTree> trees;
    TriangleGrid zone;                       ///< sheets and margins, in the order of the faults
    std::vector<std::int32_t> barrier_of;    ///< of each triangle in the zone
    std::vector<double> squared_protection;  ///< of each triangle in the zone
    std::set<std::pair<std::int32_t, std::int32_t>> meeting;
};

Sheets::Sheets(std::span<const Barrier> given) : barriers(given) {
    std::vector<TriangleCorners> triangles;
    std::vector<double> reach;
    for (const Barrier& barrier : barriers) {
        const auto index = static_cast<std::int32_t>(trees.size());
        for (const Surface* part : {&barrier.sheet, &barrier.margin}) {
            for (const Triangle& t : part->triangles) {
                triangles.push_back({part->vertices[t[0]], part->vertices[t[1]], part->vertices[t[2]]});
            }
        }
        for (const double radius : protection_radii(barriers, static_cast<std::size_t>(index))) {
            reach.push_back(radius);
            squared_protection.push_back(radius * radius);
        }
        barrier_of.resize(triangles.size(), index);
        trees.emplace_back(barrier.sheet.vertices, barrier.sheet.triangles);
    }
    zone = TriangleGrid(std::move(triangles), reach);
    std::map<Vec3, std::vector<std::int32_t>> users;
    for (std::size_t f = 0; f < barriers.size(); ++f) {
        for (const Vec3& p : barriers[f].sheet.vertices) {
            users[p].push_back(static_cast<std::int32_t>(f));
        }
    }
    for (const auto& [p, list] : users) {
        for (const std::int32_t a : list) {
            for (const std::int32_t b : list) {
                meeting.emplace(a, b);
            }
        }
    }
}

/// A fault that bars: its sheet, and what goes on from it.
struct Bar {
    std::size_t barrier;
    const TriangleTree* sheet;
    TriangleTree beyond;
    std::vector<EdgePlace> rims;
    FreeRims near_rims;
};

}  // namespace

struct BarrierQuery::Impl {
    Impl(std::shared_ptr<const Sheets> of, const std::vector<EstimationBarrier>& of_each, const Box3& inner)
        : sheets(std::move(of)), covered(inner) {
        for (std::size_t f = 0; f < of_each.size(); ++f) {
            if (of_each[f].bars) {
                bars.push_back({f,
                                &sheets->trees[f],
                                TriangleTree(of_each[f].beyond.vertices, of_each[f].beyond.triangles),
                                of_each[f].rims,
                                {of_each[f].rims, sheets->barriers[f].spacing, sheets->trees[f].mean_normal()}});
            }
        }
    }

    [[nodiscard]] const TriangleTree& tree(std::int32_t barrier) const {
        assert(barrier >= 0 && static_cast<std::size_t>(barrier) < sheets->trees.size());
        return sheets->trees[static_cast<std::size_t>(barrier)];
    }

    std::shared_ptr<const Sheets> sheets;
    std::vector<Bar> bars;
    Box3 covered;                        ///< what goes on beyond a sheet stays out of it: a convex place
    std::unique_ptr<BarrierQuery> hard;  ///< with the horizons among the barriers
    std::vector<bool> hard_for;          ///< of each property
    std::once_flag turns_wanted;
    RimTurns turns;
};

BarrierQuery::BarrierQuery(std::span<const Barrier> barriers) : BarrierQuery(barriers, sheets_as_barriers(barriers)) {}

BarrierQuery::BarrierQuery(std::span<const Barrier> barriers, const EstimationBarriers& given) {
    const auto sheets = std::make_shared<const Sheets>(barriers);
    impl_ = std::make_unique<Impl>(sheets, given.soft, given.covered);
    if (!given.hard.empty()) {
        impl_->hard_for = given.hard_for;
        impl_->hard = std::make_unique<BarrierQuery>(
            BarrierQuery{std::make_unique<Impl>(sheets, given.hard, given.covered), Made{}});
    }
}

BarrierQuery::BarrierQuery(std::unique_ptr<Impl> impl, Made /*unused*/) : impl_(std::move(impl)) {}

BarrierQuery::~BarrierQuery() = default;
BarrierQuery::BarrierQuery(BarrierQuery&&) noexcept = default;
BarrierQuery& BarrierQuery::operator=(BarrierQuery&&) noexcept = default;

std::span<const Barrier> BarrierQuery::barriers() const {
    return impl_->sheets->barriers;
}

bool BarrierQuery::empty() const {
    return impl_->sheets->barriers.empty();
}

std::int32_t BarrierQuery::protecting_barrier(const Vec3& p) const {
    const Sheets& sheets = *impl_->sheets;
    for (const std::uint32_t i : sheets.zone.candidates(p)) {
        if (sheets.zone.squared_distance_to(i, p) < sheets.squared_protection[i]) {
            return sheets.barrier_of[i];
        }
    }
    return -1;
}

bool BarrierQuery::crosses(std::int32_t barrier, const Vec3& a, const Vec3& b) const {
    return impl_->tree(barrier).meets(a, b);
}

const BarrierQuery& BarrierQuery::seen_by(std::size_t property) const {
    const bool hard = property < impl_->hard_for.size() && impl_->hard_for[property];
    return hard ? *impl_->hard : *this;
}

const BarrierQuery& BarrierQuery::with_horizons() const {
    return impl_->hard ? *impl_->hard : *this;
}

bool BarrierQuery::crosses_any(const Vec3& a, const Vec3& b, std::int32_t except) const {
    const bool within = impl_->covered.contains(a) && impl_->covered.contains(b);
    for (const Bar& bar : impl_->bars) {
        if (static_cast<std::int32_t>(bar.barrier) != except &&
            (bar.sheet->meets(a, b) || (!within && bar.beyond.meets(a, b)))) {
            return true;
        }
    }
    return false;
}

double BarrierQuery::openness(const Vec3& a, const Vec3& b) const {
    if (crosses_any(a, b)) {
        return 0;
    }
    double least = 1;
    for (const Bar& bar : impl_->bars) {
        least = bar.near_rims.clearance(a, b, least);
    }
    return least;
}

bool BarrierQuery::bars(std::int32_t barrier) const {
    return std::ranges::find(impl_->bars, static_cast<std::size_t>(barrier), &Bar::barrier) != impl_->bars.end();
}

const RimTurns& BarrierQuery::turns() const {
    std::call_once(impl_->turns_wanted, [&] {
        std::vector<SheetRim> sheets;
        for (const Bar& bar : impl_->bars) {
            sheets.push_back({&impl_->sheets->barriers[bar.barrier].sheet, bar.rims});
        }
        impl_->turns = rim_turns(sheets, [&](const Vec3& a, const Vec3& b) { return !crosses_any(a, b); });
    });
    return impl_->turns;
}

Vec3 BarrierQuery::off_barriers(const Vec3& p, std::int32_t barrier, std::int8_t side) const {
    if (impl_->hard) {
        return impl_->hard->off_barriers(p, barrier, side);
    }
    if (!crosses_any(p, p)) {
        return p;
    }
    Vec3 way;
    double spacing = 0;
    const Bar* told = nullptr;  // whose side is the one asked for
    double sign = 1;
    for (const Bar& bar : impl_->bars) {
        const Vec3 normal = bar.sheet->normal_at(p) + bar.beyond.normal_at(p);
        if (normal == Vec3{}) {
            continue;
        }
        const bool asked = side != 0 && (barrier < 0 || static_cast<std::int32_t>(bar.barrier) == barrier);
        way = way + (asked && side < 0 ? -1.0 : 1.0) / length(normal) * normal;
        spacing = std::max(spacing, impl_->sheets->barriers[bar.barrier].spacing);
        if (told == nullptr || (asked && barrier >= 0)) {
            told = &bar;
            sign = asked && side < 0 ? -1 : 1;
        }
    }
    const double rounding = 1e-15 * (std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
    double step = std::max({least_step * spacing, rounding, std::numeric_limits<double>::min()});
    for (int doubling = 0; doubling < 40; ++doubling, step *= 2) {
        const Vec3 beside = p + step * way;
        const std::int8_t found =
            told->sheet->normal_at(p) == Vec3{} ? told->beyond.side_of(beside) : told->sheet->side_of(beside);
        if (found * sign > 0 && !crosses_any(beside, beside)) {
            return beside;
        }
    }
    return p;
}

bool BarrierQuery::meet(std::int32_t barrier, std::int32_t other) const {
    return barrier == other || impl_->sheets->meeting.contains({barrier, other});
}

std::int8_t BarrierQuery::side_of(std::int32_t barrier, const Vec3& p) const {
    return impl_->tree(barrier).side_of(p);
}

double BarrierQuery::distance_to_sheet(std::int32_t barrier, const Vec3& p) const {
    return impl_->tree(barrier).distance_to(p);
}

bool is_above_ground(const BarrierQuery& barriers, const Vec3& p) {
    for (std::size_t f = 0; f < barriers.barriers().size(); ++f) {
        const Surface& sheet = barriers.barriers()[f].sheet;
        if (sheet.kind == SurfaceKind::topography && !sheet.triangles.empty() &&
            barriers.side_of(static_cast<std::int32_t>(f), p) > 0) {
            return true;
        }
    }
    return false;
}

}  // namespace terratet
