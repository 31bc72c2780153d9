// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Values for voxels that have none, for viewers that blend neighbours without asking whether there is one.

#include <array>
#include <vector>

namespace terratet {

/// Fills every NaN of a box of voxels, z fastest; 0 where there is no value at all. A void beside a value goes on as
/// the two values before it do (`smooth`), so that a linear field stays linear up to the faces of its voxels; others
/// take the nearest value of their line. What a void beside a value gets depends on no voxel farther
/// than three, so that neighbouring boxes agree. With `positive` none gets below 0.
void fill_voids(const std::array<int, 3>& count, bool smooth, bool positive, std::vector<float>& values);

}  // namespace terratet
