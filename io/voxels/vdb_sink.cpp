// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// OpenVDB: a FloatGrid a property, its values from 0 to 1 in decades where it is log10, the extrapolation to mask by,
/// and the region in an Int32Grid. Voxels without a value are inactive.

#include <algorithm>
#include <variant>

#include "io/base/output_file.hpp"
#include "io/read/column_names.hpp"
#include "io/voxels/vdb_file.hpp"
#include "io/voxels/vdb_leaves.hpp"
#include "io/voxels/voxel_sink.hpp"

namespace terratet {
namespace {

using openvdb::FloatTree;
using openvdb::Int32Tree;

void describe(openvdb::MetaMap& meta, const Frame& frame, bool local_origin) {
    const Vec3 origin = local_origin ? frame.origin : Vec3{};
    meta.insertMeta("crs", openvdb::StringMetadata(frame.crs_wkt));
    meta.insertMeta("length_unit", openvdb::StringMetadata(frame.unit));
    meta.insertMeta("metres_per_unit", openvdb::DoubleMetadata(frame.metres_per_unit));
    meta.insertMeta("origin", openvdb::Vec3DMetadata(openvdb::Vec3d(origin.x, origin.y, origin.z)));
}

void describe(openvdb::MetaMap& meta, const Property& property) {
    const bool categorical = property.kind == Kind::categorical;
    // Not "name", which is where OpenVDB itself keeps the grid's.
    meta.insertMeta("property", openvdb::StringMetadata(property.name));
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

/// One grid of the file.
struct Output {
    std::size_t field = 0;
    bool normalised = false;
    std::string name;
    std::variant<SpilledGrid<FloatTree>::Ptr, SpilledGrid<Int32Tree>::Ptr> grid;
};

struct Piece final : BrickPiece {
    std::vector<std::variant<LeafBlock<FloatTree>, LeafBlock<Int32Tree>>> blocks;  ///< one an output
};

class VdbSink final : public VoxelSink {
  public:
    VdbSink(const VoxelGrid& grid, const std::string& path, const ExportOptions& options)
        : grid_(grid), options_(options), path_(path), file_(path, options.overwrite), spill_(path) {
        file_.close();
        openvdb::initialize();
        std::vector<std::string> names;
        std::vector<const char*> taken;
        for (const VoxelLayer& layer : grid.layers) {
            taken.push_back(layer.plain_name.c_str());
            if (layer.is_log10()) {
                names.push_back(layer.plain_name + "_normalised");
            }
        }
        names = distinct_names(std::move(names), taken);
        auto next = names.begin();
        for (std::size_t f = 0; f < grid.layers.size(); ++f) {
            add(f, false, grid.layers[f].plain_name);
            if (grid.layers[f].is_log10()) {
                add(f, true, *next++);
            }
        }
    }

    [[nodiscard]] std::unique_ptr<BrickPiece> prepare(const Brick& brick) const override {
        auto piece = std::make_unique<Piece>();
        for (const Output& output : outputs_) {
            const std::vector<float>& values = brick.values[output.field];
            const VoxelLayer& layer = grid_.layers[output.field];
            if (std::holds_alternative<SpilledGrid<Int32Tree>::Ptr>(output.grid)) {
                piece->blocks.emplace_back(pack_leaves<Int32Tree>(
                    brick, values, false, [](float number) { return static_cast<std::int32_t>(number); }));
            } else if (output.normalised) {
                piece->blocks.emplace_back(pack_leaves<FloatTree>(brick, values, options_.half, [&layer](float number) {
                    const double decades = to_scale(layer.property, static_cast<double>(number));
                    return static_cast<float>(std::clamp((decades - layer.low) / (layer.high - layer.low), 0.0, 1.0));
                }));
            } else {
                piece->blocks.emplace_back(pack_leaves<FloatTree>(brick, values, options_.half && !layer.is_class(),
                                                                  [](float number) { return number; }));
            }
        }
        return piece;
    }

    [[nodiscard]] bool portable() const override { return true; }

    [[nodiscard]] std::string to_bytes(const BrickPiece& made) const override {
        ByteWriter out;
        for (const auto& block : static_cast<const Piece&>(made).blocks) {
            std::visit([&](const auto& leaves) { put_leaves(leaves, out); }, block);
        }
        return out.take();
    }

    [[nodiscard]] std::unique_ptr<BrickPiece> from_bytes(std::string_view bytes) const override {
        auto piece = std::make_unique<Piece>();
        ByteReader in(bytes);
        for (const Output& output : outputs_) {
            std::visit(
                [&](const auto& grid) {
                    using Block = typename std::remove_reference_t<decltype(*grid)>::Block;
                    piece->blocks.emplace_back(get_leaves<Block>(in));
                },
                output.grid);
        }
        return piece;
    }

    void put(const Brick&, std::unique_ptr<BrickPiece> made) override {
        const auto& piece = static_cast<const Piece&>(*made);
        for (std::size_t o = 0; o < outputs_.size(); ++o) {
            std::visit(
                [&](const auto& grid) {
                    using Block = typename std::remove_reference_t<decltype(*grid)>::Block;
                    grid->add(std::get<Block>(piece.blocks[o]));
                },
                outputs_[o].grid);
        }
    }

    void close() override {
        openvdb::GridPtrVec grids;
        for (const Output& output : outputs_) {
            std::visit([&](const auto& grid) { grids.push_back(grid); }, output.grid);
        }
        openvdb::MetaMap meta;
        describe(meta, grid_.frame, options_.local_origin);
        write_vdb_file(file_.temporary_path(), path_, grids, meta);
    }
    [[nodiscard]] OutputRecord commit() override { return {path_, file_.commit()}; }

  private:
    void add(std::size_t field, bool normalised, const std::string& name) {
        const VoxelLayer& layer = grid_.layers[field];
        Output output{field, normalised, name, {}};
        if (layer.role == VoxelLayer::Role::region) {
            output.grid = openvdb::SharedPtr<SpilledGrid<Int32Tree>>(new SpilledGrid<Int32Tree>(spill_));
        } else {
            output.grid = openvdb::SharedPtr<SpilledGrid<FloatTree>>(new SpilledGrid<FloatTree>(spill_));
        }
        std::visit(
            [&](const auto& grid) {
                grid->setName(name);
                grid->setTransform(transform());
                grid->setSaveFloatAsHalf(options_.half && !layer.is_class());
                describe(*grid, grid_.frame, options_.local_origin);
                describe(*grid, layer.property);
                if (normalised) {
                    grid->insertMeta("scale", openvdb::StringMetadata("0 to 1 in decades"));
                    grid->insertMeta("decades", openvdb::Vec2DMetadata(openvdb::Vec2d(layer.low, layer.high)));
                }
            },
            output.grid);
        outputs_.push_back(std::move(output));
    }

    /// Index (i,j,k), a voxel's centre, to true coordinates, or to true lengths from the frame's origin.
    [[nodiscard]] openvdb::math::Transform::Ptr transform() const {
        const Vec3 o = options_.local_origin ? grid_.origin - grid_.frame.origin : grid_.origin;
        const Vec3& s = grid_.spacing;
        return openvdb::math::Transform::createLinearTransform(
            openvdb::Mat4R(s.x, 0., 0., 0., 0., s.y, 0., 0., 0., 0., s.z, 0., o.x, o.y, o.z, 1.));
    }

    const VoxelGrid& grid_;
    ExportOptions options_;
    std::string path_;
    OutputFile file_;
    SpillFile spill_;
    std::vector<Output> outputs_;
};

}  // namespace

std::unique_ptr<VoxelSink> make_vdb_sink(const VoxelGrid& grid, const std::string& path, const ExportOptions& options) {
    return std::make_unique<VdbSink>(grid, path, options);
}

}  // namespace terratet
