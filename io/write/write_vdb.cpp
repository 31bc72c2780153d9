// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// One FloatGrid a property: the tessellation's linear field at the voxels' centres. Voxels without a value are
/// inactive. A last one is the vertices' extrapolation, to mask by.

#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

#include "interp/voxels/resample.hpp"
#include "io/base/output_file.hpp"
#include "io/export.hpp"
#include "io/read/column_names.hpp"
#include "io/write/vdb_file.hpp"

namespace terratet {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;

/// Of voxels outside; inactive, so only tools that ignore the active mask see it.
constexpr float background = 0;

constexpr const char* extrapolation_name = "extrapolation";

/// Makes the leaves of each tile and keeps those that have an active voxel.
class LeafSink final : public TileSink {
  public:
    void tile(const Tile& tile) override {
        std::vector<std::unique_ptr<Leaf>> leaves;
        constexpr int step = static_cast<int>(Leaf::DIM);
        for (int x = 0; x < Tile::edge; x += step) {
            for (int y = 0; y < Tile::edge; y += step) {
                for (int z = 0; z < Tile::edge; z += step) {
                    if (auto leaf = make_leaf(tile, x, y, z)) {
                        leaves.push_back(std::move(leaf));
                    }
                }
            }
        }
        const std::lock_guard lock(mutex_);
        std::move(leaves.begin(), leaves.end(), std::back_inserter(leaves_));
    }

    /// The tiles come in any order; the tree is built in one.
    openvdb::FloatGrid::Ptr take_grid() {
        std::sort(leaves_.begin(), leaves_.end(),
                  [](const auto& a, const auto& b) { return a->origin() < b->origin(); });
        auto grid = openvdb::FloatGrid::create(background);
        for (auto& leaf : leaves_) {
            grid->tree().addLeaf(leaf.release());
        }
        leaves_.clear();
        return grid;
    }

  private:
    static std::unique_ptr<Leaf> make_leaf(const Tile& tile, int x, int y, int z) {
        const openvdb::Coord origin(static_cast<int>(tile.lo[0]) + x, static_cast<int>(tile.lo[1]) + y,
                                    static_cast<int>(tile.lo[2]) + z);
        std::unique_ptr<Leaf> leaf;
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 8; ++j) {
                const float* row =
                    tile.values.data() +
                    (static_cast<std::size_t>(x + i) * Tile::edge + static_cast<std::size_t>(y + j)) * Tile::edge + z;
                for (int k = 0; k < 8; ++k) {
                    if (!std::isnan(row[k])) {
                        if (!leaf) {
                            leaf = std::make_unique<Leaf>(origin, background, false);
                        }
                        leaf->setValueOn(static_cast<openvdb::Index>(i * 64 + j * 8 + k), row[k]);
                    }
                }
            }
        }
        return leaf;
    }

    std::mutex mutex_;
    std::vector<std::unique_ptr<Leaf>> leaves_;
};

/// Index (i,j,k), a voxel's centre, to true coordinates, or to true lengths from the frame's origin.
openvdb::math::Transform::Ptr make_transform(const Lattice& lattice, const Frame& frame, bool local_origin) {
    const Vec3 o = local_origin ? frame.to_world_size(lattice.origin) : frame.to_world(lattice.origin);
    const Vec3 s = frame.to_world_size(lattice.spacing);
    return openvdb::math::Transform::createLinearTransform(
        openvdb::Mat4R(s.x, 0., 0., 0., 0., s.y, 0., 0., 0., 0., s.z, 0., o.x, o.y, o.z, 1.));
}

void describe(openvdb::MetaMap& meta, const Frame& frame, bool local_origin) {
    const Vec3 origin = local_origin ? frame.origin : Vec3{};
    meta.insertMeta("crs", openvdb::StringMetadata(frame.crs_wkt));
    meta.insertMeta("length_unit", openvdb::StringMetadata(frame.unit));
    meta.insertMeta("metres_per_unit", openvdb::DoubleMetadata(frame.metres_per_unit));
    meta.insertMeta("origin", openvdb::Vec3DMetadata(openvdb::Vec3d(origin.x, origin.y, origin.z)));
}

void describe(openvdb::MetaMap& meta, const Property& property) {
    const bool categorical = property.kind == Kind::categorical;
    meta.insertMeta("unit", openvdb::StringMetadata(property.unit));
    meta.insertMeta("scale", openvdb::StringMetadata(categorical                      ? "categorical"
                                                     : property.scale == Scale::log10 ? "log10"
                                                                                      : "linear"));
    if (categorical) {
        std::string classes;
        for (const std::string& name : property.classes) {
            classes += (classes.empty() ? "" : "\n") + name;
        }
        meta.insertMeta("classes", openvdb::StringMetadata(classes));
    }
}

/// \param values  of the property, or of something like one, at the vertices
openvdb::FloatGrid::Ptr make_grid(const ModelView& view, const Property& property, const std::vector<double>& values,
                                  const Lattice& lattice, const BarrierQuery& faults, const Progress& progress) {
    std::vector<double> scaled = values;
    for (double& value : scaled) {
        value = to_scale(property, value);
    }
    const OwnSide sides(view.mesh, view.cells.barrier, faults, view.model.domain.extent);
    LinearField field{&view.mesh, scaled};
    field.sides = &sides;
    field.log10 = property.scale == Scale::log10;
    field.categorical = property.kind == Kind::categorical;
    LeafSink sink;
    resample(field, lattice, sink, progress);
    return sink.take_grid();
}

/// The vertices' extrapolation; none where no property has a value, as above the ground.
std::vector<double> extrapolation_of_values(const VertexValues& vertices) {
    std::vector<double> out = vertices.extrapolation;
    for (std::size_t v = 0; v < out.size(); ++v) {
        if (std::all_of(vertices.values.begin(), vertices.values.end(),
                        [v](const std::vector<double>& values) { return std::isnan(values[v]); })) {
            out[v] = missing;
        }
    }
    return out;
}

}  // namespace

OutputRecord write_vdb(const ModelView& view, const std::string& path, const ExportOptions& options) {
    OutputFile file(path, options.overwrite);
    file.close();
    openvdb::initialize();
    const Model& model = view.model;
    const Lattice lattice =
        lattice_over(model.domain.extent, model.frame.to_local_size(resolved_voxel_size(view, options)));
    std::vector<std::string> names;
    for (const Property& property : model.properties) {
        names.push_back(property.name);
    }
    names = distinct_names(std::move(names), std::array{extrapolation_name});

    const BarrierQuery faults = model_proximity(model);
    openvdb::GridPtrVec grids;
    const auto add = [&](const std::string& name, const Property& property, const std::vector<double>& values,
                         const BarrierQuery& barriers) {
        const auto grid = make_grid(view, property, values, lattice, barriers, options.progress);
        grid->setName(name);
        grid->setTransform(make_transform(lattice, model.frame, options.local_origin));
        describe(*grid, model.frame, options.local_origin);
        describe(*grid, property);
        grids.push_back(grid);
    };
    for (std::size_t p = 0; p < names.size(); ++p) {
        add(names[p], model.properties[p], model.vertex_values.values[p], faults.seen_by(p));
    }
    if (!names.empty()) {
        add(extrapolation_name, {extrapolation_name, "", Scale::linear, Kind::continuous, {}},
            extrapolation_of_values(model.vertex_values), faults);
    }
    openvdb::MetaMap meta;
    describe(meta, model.frame, options.local_origin);
    write_vdb_file(file.temporary_path(), path, grids, meta);
    return {path, file.commit()};
}

}  // namespace terratet
