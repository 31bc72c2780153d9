// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where shortest ways round barriers turn: at their free rims. Places just outside the rims, and which of
/// them see each other; a way by way of them is a little longer than the shortest one, never shorter.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "tess/barrier/complex/rims.hpp"
#include "tess/surface.hpp"

namespace terratet {

struct RimTurns {
    std::vector<Vec3> places;                      ///< ascending, at most 256, spread along all rims
    std::vector<std::vector<std::uint32_t>> seen;  ///< from each which others, ascending
};

/// A sheet and those of its edges that are free rims, each with its smaller end first.
struct SheetRim {
    const Surface* sheet;
    std::span<const EdgePlace> edges;
};

/// \param free  does nothing bar the closed segment? Asked up to 33 000 times.
RimTurns rim_turns(std::span<const SheetRim> sheets, const std::function<bool(const Vec3&, const Vec3&)>& free);

}  // namespace terratet
