// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/fault_proximity.hpp"

#include <cassert>
#include <map>
#include <set>

#include "tess/fault_approach.hpp"
#include "tess/fault_rims.hpp"
#include "tess/triangle_grid.hpp"
#include "tess/triangle_tree.hpp"

namespace terratet {

struct FaultProximity::Impl {
    std::span<const Fault> faults;
    std::vector<TriangleTree> sheets;
    FaultRims rims;
    TriangleGrid zone;                       ///< sheets and margins, in the order of the faults
    std::vector<std::int32_t> fault_of;      ///< of each triangle in the zone
    std::vector<double> squared_protection;  ///< of each triangle in the zone
    std::set<std::pair<std::int32_t, std::int32_t>> meeting;
};

FaultProximity::FaultProximity(std::span<const Fault> faults) : impl_(std::make_unique<Impl>()) {
    impl_->faults = faults;
    std::vector<TriangleCorners> triangles;
    std::vector<double> reach;
    for (const Fault& fault : faults) {
        const auto index = static_cast<std::int32_t>(impl_->sheets.size());
        for (const Surface* part : {&fault.sheet, &fault.margin}) {
            for (const Triangle& t : part->triangles) {
                triangles.push_back({part->vertices[t[0]], part->vertices[t[1]], part->vertices[t[2]]});
            }
        }
        for (const double radius : protection_radii(faults, static_cast<std::size_t>(index))) {
            reach.push_back(radius);
            impl_->squared_protection.push_back(radius * radius);
        }
        impl_->fault_of.resize(triangles.size(), index);
        impl_->sheets.emplace_back(fault.sheet);
    }
    impl_->rims = FaultRims(faults);
    impl_->zone = TriangleGrid(std::move(triangles), reach);
    std::map<Vec3, std::vector<std::int32_t>> users;
    for (std::size_t f = 0; f < faults.size(); ++f) {
        for (const Vec3& p : faults[f].sheet.vertices) {
            users[p].push_back(static_cast<std::int32_t>(f));
        }
    }
    for (const auto& [p, list] : users) {
        for (const std::int32_t a : list) {
            for (const std::int32_t b : list) {
                impl_->meeting.emplace(a, b);
            }
        }
    }
}

FaultProximity::~FaultProximity() = default;
FaultProximity::FaultProximity(FaultProximity&&) noexcept = default;
FaultProximity& FaultProximity::operator=(FaultProximity&&) noexcept = default;

std::span<const Fault> FaultProximity::faults() const {
    return impl_->faults;
}

bool FaultProximity::empty() const {
    return impl_->sheets.empty();
}

std::int32_t FaultProximity::protecting_fault(const Vec3& p) const {
    for (const std::uint32_t i : impl_->zone.candidates(p)) {
        if (impl_->zone.squared_distance_to(i, p) < impl_->squared_protection[i]) {
            return impl_->fault_of[i];
        }
    }
    return -1;
}

bool FaultProximity::crosses(std::int32_t fault, const Vec3& a, const Vec3& b) const {
    assert(fault >= 0 && static_cast<std::size_t>(fault) < impl_->sheets.size());
    return impl_->sheets[static_cast<std::size_t>(fault)].meets(a, b);
}

bool FaultProximity::crosses_any(const Vec3& a, const Vec3& b, std::int32_t except) const {
    for (std::size_t f = 0; f < impl_->sheets.size(); ++f) {
        const bool bars = impl_->faults[f].sheet.kind == SurfaceKind::fault;
        if (bars && static_cast<std::int32_t>(f) != except && impl_->sheets[f].meets(a, b)) {
            return true;
        }
    }
    return false;
}

double FaultProximity::openness(const Vec3& a, const Vec3& b) const {
    return crosses_any(a, b) ? 0 : impl_->rims.clearance(a, b);
}

bool FaultProximity::meet(std::int32_t fault, std::int32_t other) const {
    return fault == other || impl_->meeting.contains({fault, other});
}

std::int8_t FaultProximity::side_of(std::int32_t fault, const Vec3& p) const {
    assert(fault >= 0 && static_cast<std::size_t>(fault) < impl_->sheets.size());
    return impl_->sheets[static_cast<std::size_t>(fault)].side_of(p);
}

double FaultProximity::distance_to_sheet(std::int32_t fault, const Vec3& p) const {
    assert(fault >= 0 && static_cast<std::size_t>(fault) < impl_->sheets.size());
    return impl_->sheets[static_cast<std::size_t>(fault)].distance_to(p);
}

bool is_above_ground(const FaultProximity& faults, const Vec3& p) {
    for (std::size_t f = 0; f < faults.faults().size(); ++f) {
        const Surface& sheet = faults.faults()[f].sheet;
        if (sheet.kind == SurfaceKind::topography && !sheet.triangles.empty() &&
            faults.side_of(static_cast<std::int32_t>(f), p) > 0) {
            return true;
        }
    }
    return false;
}

}  // namespace terratet
