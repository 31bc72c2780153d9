// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The properties of a voxel tileset, in the types and under the names that CesiumJS reads: FLOAT32 and UINT8 alone,
/// larger types first, ids that can be names in a shader, at most as many as there are texture units.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/voxels/voxel_grid.hpp"

namespace terratet {

struct TileProperty {
    enum class Content : std::uint8_t { number, class_number, mask };

    std::string id;         ///< a name in GLSL
    std::string attribute;  ///< of glTF
    std::string name;       ///< for people
    std::string description;
    Content content = Content::number;
    std::size_t field = 0;  ///< of the pyramid
    double low = 0;         ///< of the finest voxels
    double high = 0;

    [[nodiscard]] bool is_float() const { return content == Content::number; }
};

/// One tileset: of all numbers, or of one category.
struct TileClass {
    std::string folder;  ///< within the output's; empty: the numbers'
    std::vector<TileProperty> properties;

    [[nodiscard]] nlohmann::ordered_json schema() const;
    [[nodiscard]] nlohmann::ordered_json statistics() const;
};

/// Most properties of a tileset: one texture each, and shaders have 16.
inline constexpr std::size_t most_tile_properties = 12;

/// \param mask_field   of the pyramid: where there is any value
/// \param own_mask     by layer: it lacks values where others have some
/// \param low, high    by layer, in the scale of what is stored (log10 of a log10 property)
std::vector<TileClass> tile_classes(const std::vector<VoxelLayer>& layers, std::size_t mask_field,
                                    const std::vector<bool>& own_mask, const std::vector<double>& low,
                                    const std::vector<double>& high);

/// Of `name`, so that it is no word of GLSL and ends up in no reserved name.
std::string shader_name(const std::string& name);

/// A number near `value`, not nearer to 0, that JavaScript writes so that a shader takes it: never as `1e-7`.
double shader_number(double value);

}  // namespace terratet
