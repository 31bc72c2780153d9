// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where voxel tiles lie on the globe: a box that is turned into place, or for axes in degrees a region of the
/// ellipsoid.

#include <nlohmann/json.hpp>

#include <string>

#include "io/voxels/voxel_grid.hpp"

namespace terratet {

struct TilesPlace {
    using Json = nlohmann::ordered_json;

    bool region = false;  ///< x, y, z are longitude and latitude in degrees and height in metres
    bool on_globe = true;
    Vec3 center;           ///< of the grid, true coordinates: the origin of the box's axes
    Vec3 metres;           ///< box: per unit of each axis, the grid's scale at its centre
    Json transform;        ///< box: 16 numbers, column-major, from metres along its axes to earth-centred ones
    double deviation = 0;  ///< box: the farthest that a corner of the grid is from where PROJ has it, metres
    std::string remark;    ///< what a user should know of heights and place; may be empty

    /// `lo`, `hi`: corners in true coordinates.
    [[nodiscard]] Json bounding_volume(const Vec3& lo, const Vec3& hi) const;
    /// The shape of a tile in its glTF, by KHR_implicit_shapes.
    [[nodiscard]] Json shape(const Vec3& lo, const Vec3& hi) const;
};

/// By PROJ. \param vertical  EPSG code of the heights' system, for a system that says none; may be empty.
/// Throws UsageError when PROJ does not know it.
TilesPlace place_tiles(const VoxelGrid& grid, const std::string& vertical);

}  // namespace terratet
