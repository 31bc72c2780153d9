// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/grids/grid_source.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "io/base/crs.hpp"
#include "io/base/lower_case.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

std::string extension_of(const std::string& path) {
    return lower_case(std::filesystem::path(path).extension().string());
}

bool is_table(const std::string& extension) {
    return extension == ".csv" || extension == ".txt" || extension == ".xyz" || extension == ".dat";
}

/// Of log10 properties, for what is shaded by it.
void set_ranges(GridContents& contents) {
    for (std::size_t f = 0; f < contents.grid.layers.size(); ++f) {
        VoxelLayer& layer = contents.grid.layers[f];
        if (!layer.is_log10()) {
            continue;
        }
        double low = std::numeric_limits<double>::infinity();
        double high = -low;
        std::vector<float> values;
        const auto& n = contents.grid.size;
        for (std::int64_t x = 0; x < n[0]; x += Brick::edge) {
            for (std::int64_t y = 0; y < n[1]; y += Brick::edge) {
                for (std::int64_t z = 0; z < n[2]; z += Brick::edge) {
                    if (contents.blocks->is_empty(f, {x / Brick::edge, y / Brick::edge, z / Brick::edge})) {
                        continue;
                    }
                    contents.blocks->gather(0, f, {x, y, z}, {Brick::edge, Brick::edge, Brick::edge}, values);
                    for (const float value : values) {
                        if (value > 0) {
                            low = std::min(low, std::log10(static_cast<double>(value)));
                            high = std::max(high, std::log10(static_cast<double>(value)));
                        }
                    }
                }
            }
        }
        if (low < high) {
            layer.low = low;
            layer.high = high;
        }
    }
}

}  // namespace

GridSource::GridSource(GridContents contents) : contents_(std::move(contents)) {
    const VoxelGrid& grid = contents_.grid;
    lattice_ = {grid.frame.to_local(grid.origin), grid.frame.to_local_size(grid.spacing), grid.size};
}

void GridSource::fill(Brick& brick) const {
    for (std::size_t f = 0; f < fields(); ++f) {
        std::vector<float>& values = brick.values[f];
        values.clear();
        if (contents_.blocks->is_empty(
                f, {brick.lo[0] / Brick::edge, brick.lo[1] / Brick::edge, brick.lo[2] / Brick::edge})) {
            continue;
        }
        contents_.blocks->gather(0, f, brick.lo, {Brick::edge, Brick::edge, Brick::edge}, values);
        if (std::ranges::all_of(values, [](float value) { return std::isnan(value); })) {
            values.clear();
        }
    }
}

bool names_grid(const std::string& path) {
    const std::string extension = extension_of(path);
    return is_table(extension) || extension == ".tif" || extension == ".tiff" || extension == ".nc" ||
           extension == ".vdb" || extension == ".cog" || extension == ".nc4";
}

std::unique_ptr<GridSource> read_grid(const Source& source, const std::string& srs, const std::string& spill) {
    const std::string extension = extension_of(source.path);
    GridContents contents = extension == ".vdb"   ? read_vdb_grids(source, spill)
                            : is_table(extension) ? read_table_grid(source, spill)
                                                  : read_raster_cube(source, spill);
    const std::string& given = source.srs.empty() ? srs : source.srs;
    if (!given.empty() && (contents.grid.frame.crs_wkt.empty() || !source.srs.empty())) {
        set_grid_crs(parse_crs(given).wkt, contents.grid);
    }
    set_ranges(contents);
    return std::make_unique<GridSource>(std::move(contents));
}

VoxelLayer grid_layer(const std::string& name, const std::string& unit, bool categorical, bool log10,
                      std::vector<std::string> classes) {
    VoxelLayer layer;
    layer.property.name = name;
    layer.property.unit = unit;
    layer.property.scale = log10 && !categorical ? Scale::log10 : Scale::linear;
    layer.property.kind = categorical ? Kind::categorical : Kind::continuous;
    layer.property.classes = std::move(classes);
    layer.role = name == "extrapolation"           ? VoxelLayer::Role::extrapolation
                 : name == "region" && categorical ? VoxelLayer::Role::region
                                                   : VoxelLayer::Role::property;
    return layer;
}

void set_grid_crs(const std::string& wkt, VoxelGrid& grid) {
    const Crs crs = crs_from_wkt(wkt);
    grid.frame.crs_wkt = crs.wkt;
    grid.frame.crs_name = crs.name;
    if (!crs.empty()) {
        grid.frame.unit = crs.unit;
        grid.frame.metres_per_unit = crs.geographic ? 1 : crs.metres_per_unit;
    }
}

std::unique_ptr<VoxelPyramid> make_blocks(const VoxelGrid& grid, const std::string& spill) {
    return std::make_unique<VoxelPyramid>(grid.size, std::vector<Merging>(grid.layers.size(), Merging::mean), 1, spill);
}

}  // namespace terratet
