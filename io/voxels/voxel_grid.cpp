// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/voxel_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/read/column_names.hpp"

namespace terratet {
namespace {

bool is_plain(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

/// In decades, of all vertices; 0 and 1 where there is no range.
void set_range(const std::vector<double>& values, VoxelLayer& layer) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double value : values) {
        const double scaled = to_scale(layer.property, value);
        if (std::isfinite(scaled)) {
            low = std::min(low, scaled);
            high = std::max(high, scaled);
        }
    }
    if (low < high) {
        layer.low = low;
        layer.high = high;
    }
}

}  // namespace

std::string plain_name(const std::string& name) {
    std::string plain;
    for (const char c : name) {
        if (is_plain(c)) {
            plain += c;
        } else if (!plain.empty() && plain.back() != '_') {
            plain += '_';
        }
    }
    while (!plain.empty() && plain.back() == '_' && name.back() != '_') {
        plain.pop_back();
    }
    return plain.empty() ? "property" : plain.front() >= '0' && plain.front() <= '9' ? "_" + plain : plain;
}

void name_layers(std::vector<VoxelLayer>& layers) {
    // What is no property keeps its name.
    std::vector<const char*> taken;
    std::vector<std::string> names;
    for (const VoxelLayer& layer : layers) {
        if (layer.role == VoxelLayer::Role::property) {
            names.push_back(plain_name(layer.property.name));
        } else {
            taken.push_back(layer.property.name.c_str());
        }
    }
    names = distinct_names(std::move(names), taken);
    auto next = names.begin();
    for (VoxelLayer& layer : layers) {
        layer.plain_name = layer.role == VoxelLayer::Role::property ? *next++ : layer.property.name;
    }
}

VoxelGrid voxel_grid(const Model& model, const std::vector<std::string>& region_names, const Lattice& lattice) {
    VoxelGrid grid;
    grid.origin = model.frame.to_world(lattice.origin);
    grid.spacing = model.frame.to_world_size(lattice.spacing);
    grid.size = lattice.size;
    grid.frame = model.frame;
    for (std::size_t p = 0; p < model.properties.size(); ++p) {
        VoxelLayer layer{model.properties[p], VoxelLayer::Role::property, {}};
        if (layer.is_log10()) {
            set_range(model.vertex_values.values[p], layer);
        }
        grid.layers.push_back(layer);
    }
    grid.layers.push_back(
        {{"extrapolation", "", Scale::linear, Kind::continuous, {}}, VoxelLayer::Role::extrapolation, {}});
    grid.layers.push_back(
        {{"region", "", Scale::linear, Kind::categorical, region_names}, VoxelLayer::Role::region, {}});
    name_layers(grid.layers);
    return grid;
}

}  // namespace terratet
