// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/sheet_sides.hpp"

namespace terratet {

SheetSides::SheetSides(const SiteMesh& sites) : sites_(sites) {
    if (const BarrierQuery* barriers = sites.barriers()) {
        for (std::size_t f = 0; f < barriers->barriers().size(); ++f) {
            const auto index = static_cast<std::int32_t>(f);
            if (barriers->bars(index) && !barriers->barriers()[f].sheet.triangles.empty()) {
                barriers_.push_back(index);
            }
        }
        const auto count = static_cast<std::size_t>(sites.tessellation().site_count());
        known_sides_ = std::make_unique<std::atomic<std::int8_t>[]>(count * barriers_.size());
    }
}

void SheetSides::squared_distances(std::int32_t site, std::vector<double>& out) const {
    out.clear();
    for (const std::int32_t barrier : barriers_) {
        const double distance = sites_.barriers()->distance_to_sheet(barrier, sites_.place(site));
        out.push_back(distance * distance);
    }
}

bool SheetSides::part(std::int32_t site, std::int32_t other, std::span<const double> distances) const {
    const double apart = squared_distance(sites_.place(site), sites_.place(other));
    for (std::size_t b = 0; b < barriers_.size(); ++b) {
        if (distances[b] <= apart && side(b, site) != side(b, other)) {
            return true;
        }
    }
    return false;
}

int SheetSides::side(std::size_t barrier, std::int32_t site) const {
    auto& known = known_sides_[static_cast<std::size_t>(site) * barriers_.size() + barrier];
    std::int8_t side = known.load(std::memory_order_relaxed);
    if (side == 0) {  // whoever finds it finds the same
        constexpr std::int8_t on_it = 2;
        const std::int8_t found = sites_.barriers()->side_of(barriers_[barrier], sites_.place(site));
        side = found == 0 ? on_it : found;
        known.store(side, std::memory_order_relaxed);
    }
    return side;
}

}  // namespace terratet
