// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cells that fill a space, told by the walls between them.

#include <cstdint>
#include <span>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// A wall of a cell, a polygon whose corners turn counterclockwise as seen from beyond it.
struct VoronoiWall {
    std::uint32_t begin = 0;  ///< its corners, in VoronoiComplex::corners
    std::uint32_t end = 0;
    std::uint32_t cell = 0;
    std::int32_t beyond = 0;  ///< the cell on the other side, a larger number; else −1 − the side of what holds all
};

/// The walls of each cell close it: every edge is passed once in either direction.
struct VoronoiComplex {
    std::vector<Vec3> points;
    std::vector<std::uint32_t> corners;
    std::vector<VoronoiWall> walls;

    [[nodiscard]] std::span<const std::uint32_t> polygon(const VoronoiWall& wall) const {
        return std::span(corners).subspan(wall.begin, wall.end - wall.begin);
    }
    void add(std::span<const std::uint32_t> polygon, std::uint32_t cell, std::int32_t beyond) {
        const auto begin = static_cast<std::uint32_t>(corners.size());
        corners.insert(corners.end(), polygon.begin(), polygon.end());
        walls.push_back({begin, static_cast<std::uint32_t>(corners.size()), cell, beyond});
    }
};

/// Sides of a box as VoronoiWall::beyond tells them: −1 − (2 axis + end). That of what the model ends at otherwise,
/// ground or a domain's walls, comes next.
inline constexpr std::int32_t beyond_bound = -7;

}  // namespace terratet
