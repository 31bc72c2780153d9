// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <sstream>
#include <type_traits>

#include <fmt/format.h>

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

/// The voxels that are looked at, from the first on, and which of its blocks hold an active one.
class ActiveBlocks {
  public:
    ActiveBlocks(const openvdb::CoordBBox& box, const std::array<std::int64_t, 3>& size) : first_(box.min()) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            counts_[axis] = (size[axis] + Brick::edge - 1) / Brick::edge;
        }
        active_.resize(static_cast<std::size_t>(counts_[0] * counts_[1] * counts_[2]));
    }

    void mark(const openvdb::GridBase& grid) {
        grid.isType<openvdb::FloatGrid>()    ? mark_in(static_cast<const openvdb::FloatGrid&>(grid))
        : grid.isType<openvdb::DoubleGrid>() ? mark_in(static_cast<const openvdb::DoubleGrid&>(grid))
        : grid.isType<openvdb::Int32Grid>()  ? mark_in(static_cast<const openvdb::Int32Grid&>(grid))
                                             : mark_in(static_cast<const openvdb::Int64Grid&>(grid));
    }

    void for_each(const std::function<void(const VoxelPyramid::Index&)>& visit) const {
        for (std::size_t b = 0; b < active_.size(); ++b) {
            const auto n = static_cast<std::int64_t>(b);
            if (active_[b]) {
                visit({n / (counts_[1] * counts_[2]), n / counts_[2] % counts_[1], n % counts_[2]});
            }
        }
    }

  private:
    /// By leaves, and by tiles that are active as a whole, so that what is empty costs nothing.
    template <class GridT>
    void mark_in(const GridT& grid) {
        for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
            if (!leaf->isEmpty()) {
                mark(leaf->getNodeBoundingBox());
            }
        }
        auto tile = grid.tree().cbeginValueOn();
        tile.setMaxDepth(std::decay_t<decltype(tile)>::LEAF_DEPTH - 1);
        for (; tile; ++tile) {
            openvdb::CoordBBox box;
            tile.getBoundingBox(box);
            mark(box);
        }
    }

    void mark(const openvdb::CoordBBox& box) {
        std::array<std::int64_t, 3> lo{};
        std::array<std::int64_t, 3> hi{};
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const std::int64_t from = std::int64_t{box.min()[axis]} - first_[axis];
            lo[a] = std::max<std::int64_t>(from, 0) / Brick::edge;
            hi[a] = std::min((std::int64_t{box.max()[axis]} - first_[axis]) / Brick::edge, counts_[a] - 1);
        }
        for (std::int64_t i = lo[0]; i <= hi[0]; ++i) {
            for (std::int64_t j = lo[1]; j <= hi[1]; ++j) {
                const std::size_t row = static_cast<std::size_t>((i * counts_[1] + j) * counts_[2]);
                std::fill(active_.begin() + static_cast<std::ptrdiff_t>(row) + lo[2],
                          active_.begin() + static_cast<std::ptrdiff_t>(row) + hi[2] + 1, true);
            }
        }
    }

    openvdb::Coord first_;
    std::array<std::int64_t, 3> counts_{};
    std::vector<bool> active_;
};

/// Voxels along the axes of a box, which may be wider than OpenVDB's own numbers say.
std::array<std::int64_t, 3> size_of(const openvdb::CoordBBox& box, const Source& source) {
    std::array<std::int64_t, 3> size{};
    double blocks = 1;
    for (int axis = 0; axis < 3; ++axis) {
        auto& along = size[static_cast<std::size_t>(axis)];
        along = std::int64_t{box.max()[axis]} - box.min()[axis] + 1;
        blocks *= std::ceil(static_cast<double>(along) / Brick::edge);
    }
    constexpr double most_blocks = 1 << 25;
    if (blocks > most_blocks) {
        throw InputError(
            fmt::format("{}: its active voxels lie in a box of {} x {} x {}, which is more than can be "
                        "read; deactivate those far outside",
                        source.describe(), size[0], size[1], size[2]));
    }
    return size;
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
    grid.size = size_of(box, source);
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
    ActiveBlocks blocks(box, grid.size);
    std::ranges::for_each(grids, [&](const auto& one) { blocks.mark(*one); });
    blocks.for_each([&](const VoxelPyramid::Index& block) {
        const openvdb::Coord lo =
            first.offsetBy(static_cast<int>(block[0] * Brick::edge), static_cast<int>(block[1] * Brick::edge),
                           static_cast<int>(block[2] * Brick::edge));
        std::vector<std::vector<float>> values;
        std::ranges::for_each(grids, [&](const auto& one) { values.push_back(block_of(*one, lo)); });
        contents.blocks->put(block, values, same);
    });
    return contents;
}

}  // namespace terratet
