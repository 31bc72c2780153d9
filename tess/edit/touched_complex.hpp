// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which surfaces have to be prepared again when some come or go: those, and all that hang together with them.

#include <optional>
#include <span>
#include <vector>

#include "tess/surface.hpp"

namespace terratet {

/// Of `after`, by index, ascending: surfaces that are not in `before`, and those that lie within `reach` of such, of
/// one that has left, or of each other on the way there. Distance is that of triangles' boxes: rather too many than too
/// few. O(triangles²) for surfaces whose boxes come near.
std::vector<std::size_t> touched_complex(std::span<const Surface> before, std::span<const Surface> after, double reach);

}  // namespace terratet
