// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/site/canonical_site.hpp"

#include <algorithm>
#include <utility>

namespace terratet {

std::size_t canonicalise(Site& site) {
    std::vector<std::int32_t> order(site.boreholes.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        order[i] = static_cast<std::int32_t>(i);
    }
    std::ranges::sort(order, {}, [&](std::int32_t i) { return site.boreholes[static_cast<std::size_t>(i)].id; });
    std::vector<std::int32_t> rank(order.size());
    std::vector<Borehole> boreholes;
    for (std::size_t i = 0; i < order.size(); ++i) {
        rank[static_cast<std::size_t>(order[i])] = static_cast<std::int32_t>(i);
        boreholes.push_back(std::move(site.boreholes[static_cast<std::size_t>(order[i])]));
    }
    site.boreholes = std::move(boreholes);
    for (std::int32_t& owner : site.samples.borehole) {
        owner = owner < 0 ? -1 : rank[static_cast<std::size_t>(owner)];
    }
    site.samples = selected(site.samples, canonical_order(site.samples));
    const std::size_t merged = merge_coincident(site.samples, site.properties).merged;
    std::ranges::stable_sort(site.surfaces, canonical_before);
    return merged;
}

}  // namespace terratet
