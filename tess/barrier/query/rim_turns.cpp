// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/query/rim_turns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tess/base/tri_mesh.hpp"

namespace terratet {
namespace {

constexpr std::size_t most = 256;
constexpr double outside = 1e-3;  ///< off the rim, over the length of the piece that a place stands for

struct Edge {
    Vec3 from, to;
    Vec3 outward;  ///< in the triangle's plane
};

std::vector<Edge> edges_of(std::span<const SheetRim> sheets) {
    std::vector<Edge> edges;
    for (const auto& [sheet, rim] : sheets) {
        std::vector<EdgePlace> free(rim.begin(), rim.end());
        std::sort(free.begin(), free.end());
        for (const Triangle& t : sheet->triangles) {
            for (std::size_t i = 0; i < 3; ++i) {
                const Vec3 &a = sheet->vertices[t[i]], &b = sheet->vertices[t[(i + 1) % 3]];
                if (a != b && std::binary_search(free.begin(), free.end(), a < b ? EdgePlace{a, b} : EdgePlace{b, a})) {
                    const Vec3 along = unit(b - a), off = a - sheet->vertices[t[(i + 2) % 3]];
                    edges.push_back({a, b, unit(off - dot(off, along) * along)});
                }
            }
        }
    }
    return edges;
}

/// Long edges get several.
std::vector<Vec3> places_along(const std::vector<Edge>& edges) {
    double total = 0;
    for (const Edge& edge : edges) {
        total += distance(edge.from, edge.to);
    }
    std::vector<Vec3> places;
    for (const auto& [from, to, outward] : edges) {
        const double size = distance(from, to);
        const double pieces = std::max(1.0, std::ceil(size / total * most));
        for (double piece = 0.5; piece < pieces; ++piece) {
            places.push_back(from + piece / pieces * (to - from) + outside * size / pieces * outward);
        }
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
}

/// Each time the one that is farthest from those taken.
std::vector<Vec3> spread(const std::vector<Vec3>& places) {
    std::vector<Vec3> taken;
    std::vector<double> apart(places.size(), std::numeric_limits<double>::infinity());
    for (std::size_t next = 0; taken.size() < std::min(most, places.size());) {
        taken.push_back(places[next]);
        for (std::size_t i = 0; i < places.size(); ++i) {
            apart[i] = std::min(apart[i], squared_distance(places[i], taken.back()));
        }
        next = static_cast<std::size_t>(std::max_element(apart.begin(), apart.end()) - apart.begin());
    }
    std::sort(taken.begin(), taken.end());
    return taken;
}

}  // namespace

RimTurns rim_turns(std::span<const SheetRim> sheets, const std::function<bool(const Vec3&, const Vec3&)>& free) {
    RimTurns turns{spread(places_along(edges_of(sheets))), {}};
    std::erase_if(turns.places, [&](const Vec3& p) { return !is_finite(p) || !free(p, p); });
    turns.seen.resize(turns.places.size());
    for (std::uint32_t i = 0; i < turns.places.size(); ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
            if (free(turns.places[i], turns.places[j])) {
                turns.seen[i].push_back(j);
                turns.seen[j].push_back(i);
            }
        }
    }
    return turns;
}

}  // namespace terratet
