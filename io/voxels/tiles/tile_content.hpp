// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One voxel tile as binary glTF, in the order of samples of EXT_primitive_voxels as CesiumJS 1.145 reads it. Another
/// specification's layout is another such function; what it is made of stays.

#include <array>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/voxels/tiles/tile_class.hpp"

namespace terratet {

struct TileShape {
    std::array<int, 3> dimensions{};  ///< along x, y, z, without the padding of one voxel on all sides
    bool region = false;
    bool compress = false;  ///< by EXT_meshopt_compression
};

/// \param values  one a property, of dimensions + 2 voxels along each axis, z fastest, complete
/// \param shape   of KHR_implicit_shapes
std::string voxel_glb(const TileClass& tile_class, const TileShape& tile, const nlohmann::ordered_json& shape,
                      const std::vector<std::vector<float>>& values);

}  // namespace terratet
