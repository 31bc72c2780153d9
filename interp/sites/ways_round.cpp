// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "interp/sites/ways_round.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "tess/barrier/query/rim_turns.hpp"

namespace terratet {

WaysRound::WaysRound(const BarrierQuery& barriers, const Metric& metric, std::function<double(const Vec3&)> to_site)
    : barriers_(barriers), metric_(metric), to_site_(std::move(to_site)) {}

/// Dijkstra's algorithm, from all sites at once.
void WaysRound::find() const {
    const auto& [places, seen] = barriers_.turns();
    for (const Vec3& place : places) {
        at_.push_back(metric_(place));
        onwards_.push_back(to_site_(place));
    }
    std::vector<bool> settled(places.size(), false);
    for (std::size_t round = 0; round < places.size(); ++round) {
        std::size_t nearest = places.size();
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (!settled[i] && (nearest == places.size() || onwards_[i] < onwards_[nearest])) {
                nearest = i;
            }
        }
        settled[nearest] = true;
        for (const std::uint32_t i : seen[nearest]) {
            onwards_[i] = std::min(onwards_[i], onwards_[nearest] + distance(at_[i], at_[nearest]));
        }
    }
}

std::vector<std::pair<Vec3, double>> WaysRound::changed_since(const WaysRound& before) const {
    std::call_once(before.wanted_, [&] { before.find(); });
    std::call_once(wanted_, [&] { find(); });
    std::vector<std::pair<Vec3, double>> changed;
    for (std::size_t i = 0; i < at_.size(); ++i) {
        if (onwards_[i] != before.onwards_[i]) {
            changed.emplace_back(at_[i], std::min(onwards_[i], before.onwards_[i]));
        }
    }
    return changed;
}

double WaysRound::shorter(const Vec3& place, double straight) const {
    std::call_once(wanted_, [&] { find(); });
    const Vec3 at = metric_(place);
    thread_local std::vector<std::pair<double, std::size_t>> ways;
    ways.clear();
    for (std::size_t i = 0; i < at_.size(); ++i) {
        if (const double way = distance(at, at_[i]) + onwards_[i]; way < straight) {
            ways.emplace_back(way, i);
        }
    }
    std::sort(ways.begin(), ways.end());
    const auto& places = barriers_.turns().places;
    const auto found = std::find_if(ways.begin(), ways.end(),
                                    [&](const auto& way) { return !barriers_.crosses_any(place, places[way.second]); });
    return found == ways.end() ? straight : found->first;
}

}  // namespace terratet
