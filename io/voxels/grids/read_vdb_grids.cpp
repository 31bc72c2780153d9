// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <sstream>

#include "io/voxels/grids/grid_source.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

template <class Value>
Value meta_of(const openvdb::MetaMap& meta, const char* name, const Value& otherwise) {
    const auto found = meta.getMetadata<openvdb::TypedMetadata<Value>>(name);
    return found ? found->value() : otherwise;
}

bool is_number(const openvdb::GridBase& grid) {
    return grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>() ||
           grid.isType<openvdb::Int32Grid>() || grid.isType<openvdb::Int64Grid>();
}

/// The active values of a block; empty where there are none.
template <class GridT>
std::vector<float> block_of(const openvdb::GridBase& base, const openvdb::Coord& lo) {
    const auto& grid = static_cast<const GridT&>(base);
    constexpr int edge = Brick::edge;
    auto accessor = grid.getConstAccessor();
    std::vector<float> values;
    for (int i = 0; i < edge; ++i) {
        for (int j = 0; j < edge; ++j) {
            for (int k = 0; k < edge; ++k) {
                typename GridT::ValueType value{};
                if (accessor.probeValue(lo.offsetBy(i, j, k), value)) {
                    values.resize(std::size_t{edge} * edge * edge, std::numeric_limits<float>::quiet_NaN());
                    values[Brick::index(i, j, k)] = static_cast<float>(value);
                }
            }
        }
    }
    return values;
}

std::vector<float> block_of(const openvdb::GridBase& grid, const openvdb::Coord& lo) {
    return grid.isType<openvdb::FloatGrid>()    ? block_of<openvdb::FloatGrid>(grid, lo)
           : grid.isType<openvdb::DoubleGrid>() ? block_of<openvdb::DoubleGrid>(grid, lo)
           : grid.isType<openvdb::Int32Grid>()  ? block_of<openvdb::Int32Grid>(grid, lo)
                                                : block_of<openvdb::Int64Grid>(grid, lo);
}

VoxelLayer layer_of(const openvdb::GridBase& grid) {
    const std::string scale = meta_of<std::string>(grid, "scale", "");
    std::vector<std::string> classes;
    std::istringstream lines(meta_of<std::string>(grid, "classes", ""));
    for (std::string line; std::getline(lines, line);) {
        classes.push_back(line);
    }
    const bool integer = grid.isType<openvdb::Int32Grid>() || grid.isType<openvdb::Int64Grid>();
    const std::string name = grid.getName().empty() ? "value" : grid.getName();
    return grid_layer(meta_of<std::string>(grid, "property", name), meta_of<std::string>(grid, "unit", ""),
                      integer || scale == "categorical", scale == "log10", std::move(classes));
}

openvdb::GridPtrVec open_grids(const Source& source) {
    static std::once_flag once;
    std::call_once(once, openvdb::initialize);
    try {
        openvdb::io::File file(source.path);
        file.open(false);
        const openvdb::GridPtrVecPtr all = file.getGrids();
        openvdb::GridPtrVec result;
        for (const auto& grid : *all) {
            const bool wanted = source.layer.empty() ? !grid->getMetadata<openvdb::Vec2DMetadata>("decades")
                                                     : grid->getName() == source.layer;
            if (wanted && is_number(*grid) && !grid->evalActiveVoxelBoundingBox().empty()) {
                result.push_back(grid);
            }
        }
        return result;
    } catch (const std::exception& error) {
        throw InputError(source.describe() + ": OpenVDB cannot read it: " + error.what());
    }
}

}  // namespace

GridContents read_vdb_grids(const Source& source, const std::string& spill) {
    const openvdb::GridPtrVec grids = open_grids(source);
    if (grids.empty()) {
        throw InputError(source.describe() + ": there is no grid of numbers with an active voxel in it");
    }
    openvdb::CoordBBox box;
    const openvdb::math::Transform& transform = grids.front()->transform();
    for (const auto& grid : grids) {
        box.expand(grid->evalActiveVoxelBoundingBox());
        if (grid->transform() != transform) {
            throw InputError(source.describe() + ": its grids lie differently; name one by layer=" + grid->getName());
        }
    }
    const openvdb::Vec3d zero = transform.indexToWorld(openvdb::Vec3d(0, 0, 0));
    GridContents contents;
    VoxelGrid& grid = contents.grid;
    const auto first = box.min();
    const openvdb::Vec3d offset = meta_of(*grids.front(), "origin", openvdb::Vec3d(0, 0, 0));
    for (int axis = 0; axis < 3; ++axis) {
        openvdb::Vec3d one(0, 0, 0);
        one[axis] = 1;
        const openvdb::Vec3d step = transform.indexToWorld(one) - zero;
        grid.spacing[axis] = step[axis];
        if (!(step[axis] > 0) || std::abs(step.length() - step[axis]) > 1e-9 * step[axis]) {
            throw InputError(source.describe() + ": its axes are turned; a grid's are x, y and z");
        }
        grid.origin[axis] = zero[axis] + offset[axis] + first[axis] * step[axis];
        grid.size[static_cast<std::size_t>(axis)] = box.dim()[axis];
    }
    set_grid_crs(meta_of<std::string>(*grids.front(), "crs", ""), grid);
    if (grid.frame.crs_wkt.empty()) {
        grid.frame.unit = meta_of<std::string>(*grids.front(), "length_unit", "metre");
        grid.frame.metres_per_unit = meta_of<double>(*grids.front(), "metres_per_unit", 1);
    }
    for (const auto& one : grids) {
        grid.layers.push_back(layer_of(*one));
    }
    name_layers(grid.layers);
    contents.blocks = make_blocks(grid, spill);
    std::vector<std::size_t> same(grids.size());
    for (std::size_t g = 0; g < same.size(); ++g) {
        same[g] = g;
    }
    for (std::int64_t x = 0; x < grid.size[0]; x += Brick::edge) {
        for (std::int64_t y = 0; y < grid.size[1]; y += Brick::edge) {
            for (std::int64_t z = 0; z < grid.size[2]; z += Brick::edge) {
                std::vector<std::vector<float>> values;
                for (const auto& one : grids) {
                    values.push_back(
                        block_of(*one, first.offsetBy(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z))));
                }
                contents.blocks->put({x / Brick::edge, y / Brick::edge, z / Brick::edge}, values, same);
            }
        }
    }
    return contents;
}

}  // namespace terratet
