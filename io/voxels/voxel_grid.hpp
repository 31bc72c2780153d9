// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What a writer of voxels is told beside the bricks: where they are on the map, and what their fields are.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "interp/lattice.hpp"
#include "tess/frame.hpp"
#include "tess/model.hpp"
#include "tess/property.hpp"

namespace terratet {

/// One field of the bricks.
struct VoxelLayer {
    enum class Role : std::uint8_t { property, extrapolation, region };

    Property property;  ///< name, unit, scale; a category's classes, or the regions' names
    Role role = Role::property;
    std::string plain_name;  ///< letters, digits and _ alone, other than those of all other layers
    double low = 0;          ///< of a log10 property's values: what is drawn as 0 and as 1, in decades
    double high = 1;

    [[nodiscard]] bool is_class() const { return property.kind == Kind::categorical; }
    /// Also to be had from 0 to 1 in decades, for shading?
    [[nodiscard]] bool is_log10() const { return !is_class() && property.scale == Scale::log10; }
};

struct VoxelGrid {
    Vec3 origin;   ///< centre of voxel (0,0,0), true coordinates
    Vec3 spacing;  ///< in the map's unit
    std::array<std::int64_t, 3> size{};
    Frame frame;  ///< CRS and unit; its origin is what "local" coordinates are counted from
    std::vector<VoxelLayer> layers;

    [[nodiscard]] Vec3 center(std::int64_t i, std::int64_t j, std::int64_t k) const {
        return {origin.x + static_cast<double>(i) * spacing.x, origin.y + static_cast<double>(j) * spacing.y,
                origin.z + static_cast<double>(k) * spacing.z};
    }
    [[nodiscard]] std::int64_t count() const { return size[0] * size[1] * size[2]; }
};

/// Letters, digits and _; runs of others become one _; never empty, never with a digit first.
std::string plain_name(const std::string& name);

/// Sets plain_name of each.
void name_layers(std::vector<VoxelLayer>& layers);

/// The fields of ModelBricks in their order. \param region_names  by region
VoxelGrid voxel_grid(const Model& model, const std::vector<std::string>& region_names, const Lattice& lattice);

}  // namespace terratet
