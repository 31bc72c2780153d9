// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/barrier/prepare/crowding.hpp"

#include <algorithm>
#include <cmath>

#include "tess/base/seed_grid.hpp"
#include "tess/base/triangle_grid.hpp"

namespace terratet {
namespace {

constexpr double junction_zone = 0.45;  ///< in edge lengths: seeds nearer to a junction are its own
constexpr double screened = 1.1;        ///< see crowded_places()

}  // namespace

std::vector<char> inner_triangles(const SheetComplex& complex, const EdgeTable& edges) {
    std::vector<char> at_edge(complex.points.size(), 0);
    for (const EdgeTable::Edge& e : edges.edges()) {
        if (!is_smooth(complex, edges.triangles(e))) {
            at_edge[e.a] = 1;
            at_edge[e.b] = 1;
        }
    }
    std::vector<char> near_edge = at_edge;
    for (const Triangle& t : complex.triangles) {
        if (std::ranges::any_of(t, [&](std::uint32_t v) { return at_edge[v] != 0; })) {
            for (const std::uint32_t v : t) {
                near_edge[v] = 1;
            }
        }
    }
    std::vector<char> inner;
    for (const Triangle& t : complex.triangles) {
        inner.push_back(std::ranges::none_of(t, [&](std::uint32_t v) { return near_edge[v] != 0; }) ? 1 : 0);
    }
    return inner;
}

FinerPlace place_of(const SheetComplex& complex, std::uint32_t t) {
    return {centroid(corners(complex, t)), {complex.sheet[t]}};
}

std::vector<FinerPlace> crossing_places(const SheetComplex& complex,
                                        const std::vector<std::array<std::uint32_t, 2>>& pairs) {
    std::vector<FinerPlace> places;
    for (const auto& [s, t] : pairs) {
        for (const std::uint32_t own : {s, t}) {
            places.push_back({centroid(corners(complex, own)), {complex.sheet[s], complex.sheet[t]}});
        }
    }
    return places;
}

std::vector<FinerPlace> crowded_places(const SheetComplex& complex, const std::vector<std::vector<Seed>>& seeds,
                                       const SizeField& sizes, const std::vector<char>& walls, const Poll& poll) {
    const double spacing = sizes.spacing();
    const double horizon = 0.75 * spacing;
    std::vector<TriangleCorners> triangles;
    for (std::uint32_t t = 0; t < complex.triangles.size(); ++t) {
        triangles.push_back(corners(complex, t));
    }
    const TriangleGrid grid(std::move(triangles), std::vector<double>(complex.triangles.size(), horizon));
    std::vector<Vec3> ends;
    const EdgeTable edges(complex.triangles);
    for (const EdgeTable::Edge& e : edges.edges()) {
        const auto of_edge = edges.triangles(e);
        if (of_edge.size() > 1 && !is_smooth(complex, of_edge)) {
            for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                ends.push_back(complex.points[e.a] + share * (complex.points[e.b] - complex.points[e.a]));
            }
        }
    }
    const SeedGrid junctions(ends, 0.5 * spacing);
    std::vector<char> leaky(complex.triangles.size(), 0);
    for (std::uint32_t surface = 0; surface < seeds.size(); ++surface) {
        for (std::size_t k = 0; k < seeds[surface].size(); ++k) {
            if (k % 256 == 0) {
                ask(poll);
            }
            const Seed& seed = seeds[surface][k];
            const std::uint32_t junction = junctions.nearest(seed.position);
            if (junction != no_index &&
                distance(junctions.point(junction), seed.position) < junction_zone * sizes.at(seed.position)) {
                continue;
            }
            for (const std::uint32_t t : grid.candidates(seed.position)) {
                if (leaky[t] != 0) {
                    continue;
                }
                const bool harmless =
                    complex.sheet[t] == surface || (walls[complex.sheet[t]] != 0 && walls[surface] != 0);
                const double square = harmless ? horizon * horizon : grid.squared_distance_to(t, seed.position);
                const double size = sizes.at(centroid(corners(complex, t)));
                const double enough = screened * std::sqrt(spacing * std::sqrt(square));
                if (square < horizon * horizon && size > enough) {
                    leaky[t] = 1;
                }
            }
        }
    }
    std::vector<FinerPlace> places;
    for (std::uint32_t t = 0; t < leaky.size(); ++t) {
        if (leaky[t] != 0) {
            places.push_back(place_of(complex, t));
        }
    }
    return places;
}

}  // namespace terratet
