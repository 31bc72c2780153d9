// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which tiles of an implicit octree there are, as 3D Tiles 1.1 has it in subtrees.

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

/// Bits of x, y and z in turn, x lowest; of 21 bits each.
std::uint64_t tile_code(std::uint64_t x, std::uint64_t y, std::uint64_t z);

/// Sorted codes of the tiles of each level, coarsest first.
using TileTree = std::vector<std::vector<std::uint64_t>>;

/// Levels in one subtree.
int subtree_levels(const TileTree& tree);

/// Calls `write` with the name `level_x_y_z` and the bytes of each subtree, from the top.
void write_subtrees(const TileTree& tree, const std::function<void(const std::string&, std::string_view)>& write);

}  // namespace terratet
