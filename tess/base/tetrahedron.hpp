// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A tetrahedron's edges, facets and height.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "tess/geometry.hpp"

namespace terratet {

inline constexpr std::array<std::array<std::size_t, 2>, 6> cell_edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// The corners of the facet opposite each, counterclockwise as seen from outside a positively oriented cell.
inline constexpr std::size_t facet_corners[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};

/// The ends of one edge, and of the one it does not touch.
inline constexpr std::array<std::array<std::size_t, 4>, 3> opposite_edges{{{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}}};

/// Edges that cross nearer to an end than that, relative, do not.
inline constexpr double crossing_margin = 0.02;

struct EdgeCrossing {
    Vec3 middle;
    double apart = 0;  ///< at their nearest places
};

/// Where the segments from p[0] to p[1] and from p[2] to p[3] cross, seen along their common normal; nothing when they
/// do not, or only near an end.
inline std::optional<EdgeCrossing> edge_crossing(const std::array<Vec3, 4>& p) {
    const Vec3 u = p[1] - p[0];
    const Vec3 w = p[3] - p[2];
    const Vec3 normal = cross(u, w);
    const double square = squared_length(normal);
    if (!(square > 0)) {
        return {};
    }
    const double s = dot(cross(p[2] - p[0], w), normal) / square;
    const double t = dot(cross(p[2] - p[0], u), normal) / square;
    if (std::min({s, 1 - s, t, 1 - t}) < crossing_margin) {
        return {};
    }
    const Vec3 first = p[0] + s * u;
    const Vec3 second = p[2] + t * w;
    return EdgeCrossing{0.5 * (p[0] + s * u + p[2] + t * w), distance(first, second)};
}

/// Does it take an odd number of swaps to bring the corners into the other order?
inline bool is_odd_order(std::array<std::uint32_t, 4> corners, const std::array<std::uint32_t, 4>& order) {
    bool odd = false;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto at = static_cast<std::size_t>(std::ranges::find(corners, order[k]) - corners.begin());
        if (at != k) {
            std::swap(corners[k], corners[at]);
            odd = !odd;
        }
    }
    return odd;
}

/// Over the largest facet; negative when it is turned inside out.
inline double signed_height(const std::array<Vec3, 4>& p) {
    const double six_volumes = dot(cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]);
    double largest = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec3& a = p[(k + 1) % 4];
        largest = std::max(largest, length(cross(p[(k + 2) % 4] - a, p[(k + 3) % 4] - a)));
    }
    return largest > 0 ? six_volumes / largest : 0;
}

}  // namespace terratet
