// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which cells of a mesh share a facet, found from their corners alone.

#include <array>
#include <cstdint>
#include <vector>

namespace terratet {

/// Of each cell opposite its corner k; −1 where there is none. O(n log n).
std::vector<std::array<std::int32_t, 4>> neighbours_of(const std::vector<std::array<std::uint32_t, 4>>& cells);

}  // namespace terratet
