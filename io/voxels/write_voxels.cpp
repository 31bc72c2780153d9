// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/voxels/write_voxels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "interp/ranks/ranks.hpp"
#include "interp/voxels/model_bricks.hpp"
#include "io/base/scratch_folder.hpp"
#include "io/voxels/voxel_sink.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// The nearest of 1, 2 and 5 times a power of ten, by ratio.
double rounded_1_2_5(double value) {
    const double decade = std::pow(10.0, std::floor(std::log10(value)));
    double best = decade;
    for (const double step : {2.0, 5.0, 10.0}) {
        if (std::abs(std::log(step * decade / value)) < std::abs(std::log(best / value))) {
            best = step * decade;
        }
    }
    return best;
}

Lattice lattice_of(const ModelView& view, const ExportOptions& options) {
    const Vec3 size = resolved_voxel_size(view, options);
    const Frame& frame = view.model.frame;
    return options.aligned ? aligned_lattice(view.model.domain.extent, frame, size)
                           : lattice_over(view.model.domain.extent, frame.to_local_size(size), most_voxels);
}

VoxelGrid grid_of(const ModelView& view, const ExportOptions& options) {
    return voxel_grid(view.model, view.cells.region_name, lattice_of(view, options));
}

/// Of one voxel, uncompressed.
std::uint64_t bytes_a_voxel(const VoxelGrid& grid, const std::string& format, const ExportOptions& options) {
    std::uint64_t fields = 0;
    std::uint64_t shaded = 0;
    for (const VoxelLayer& layer : grid.layers) {
        fields += options.all_fields || format == "VDB" || format == "NETCDF" || format == "BLOCKS" ||
                  format == "VOXELTILES" || layer.role == VoxelLayer::Role::property;
        shaded += layer.is_log10() ? 1 : 0;
    }
    constexpr std::uint64_t number_in_text = 10;
    if (format == "BLOCKS") {
        return number_in_text * (6 + fields);
    }
    if (format == "VOXELTILES") {
        return 5 * (fields + shaded);  // coarser levels take a seventh more
    }
    return format == "VDB" ? (options.half ? 2 : 4) * (fields + shaded) : 4 * fields;
}

std::string gigabytes(double bytes) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g GB", bytes / 1e9);
    return text;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::unique_ptr<VoxelSink> make_sink(const VoxelGrid& grid, const VoxelOutput& output, ExportOptions options) {
    if (output.format == "VDB") {
        return make_vdb_sink(grid, output.path, options);
    }
    if (output.format == "NETCDF") {
        return make_netcdf_sink(grid, output.path, options);
    }
    if (output.format == "BLOCKS") {
        return make_blocks_sink(grid, output.path, options);
    }
    if (output.format == "VOXELTILES") {
        return make_tiles_sink(grid, output.path, options);
    }
    options.cog = options.cog || output.format == "COG";
    return make_geotiff_sink(grid, output.path, options);
}

/// At a rank that does not write: sinks that prepare bricks for rank 0's, and whose files nobody sees.
void prepare_for_root(const BrickSource& source, const VoxelGrid& grid, std::span<const VoxelOutput> outputs,
                      const ExportOptions& options) {
    const ScratchFolder scratch;
    std::vector<std::unique_ptr<VoxelSink>> sinks;
    std::vector<BrickSink*> all;
    for (const VoxelOutput& output : outputs) {
        VoxelOutput unseen = output;
        unseen.path = scratch.path() / std::to_string(all.size()) / std::filesystem::path(output.path).filename();
        std::filesystem::create_directory(std::filesystem::path(unseen.path).parent_path());
        sinks.push_back(make_sink(grid, unseen, options));
        all.push_back(sinks.back().get());
    }
    stream_bricks(source, all, options.progress, options.ranks);
}

}  // namespace

VoxelPlan plan_voxels(const VoxelGrid& grid, const VoxelOutput& output, const ExportOptions& options) {
    VoxelPlan plan{output.path, grid.size, grid.spacing, 0};
    plan.bytes = static_cast<std::uint64_t>(grid.count()) * bytes_a_voxel(grid, output.format, options);
    if (plan.bytes > large_output && !options.allow_large) {
        const double factor = std::cbrt(static_cast<double>(plan.bytes) / static_cast<double>(large_output));
        const Vec3 fits = 1.01 * factor * grid.spacing;
        throw UsageError(output.path + ": " + std::to_string(grid.size[0]) + " × " + std::to_string(grid.size[1]) +
                         " × " + std::to_string(grid.size[2]) + " voxels take up to " +
                         gigabytes(static_cast<double>(plan.bytes)) + ", more than " +
                         gigabytes(static_cast<double>(large_output)) + "; `allow_large` writes them all the same, a " +
                         "`voxel_size` of " + number(fits.x) + "," + number(fits.y) + "," + number(fits.z) +
                         " takes less");
    }
    return plan;
}

VoxelPlan plan_voxels(const ModelView& view, const VoxelOutput& output, const ExportOptions& options) {
    return plan_voxels(grid_of(view, options), output, options);
}

std::vector<OutputRecord> write_voxels(const ModelView& view, std::span<const VoxelOutput> outputs,
                                       const ExportOptions& options) {
    const VoxelGrid grid = grid_of(view, options);
    for (const VoxelOutput& output : outputs) {
        static_cast<void>(plan_voxels(grid, output, options));
    }
    ModelBrickOptions of_bricks;
    of_bricks.estimator = view.estimator;
    of_bricks.barriers = view.barriers;
    of_bricks.max_extrapolation = options.max_extrapolation.value_or(of_bricks.max_extrapolation);
    const ModelBricks bricks(view.model, view.mesh, view.cells, lattice_of(view, options), of_bricks);
    return write_voxels(bricks, grid, outputs, options);
}

std::vector<OutputRecord> write_voxels(const BrickSource& source, const VoxelGrid& grid,
                                       std::span<const VoxelOutput> outputs, const ExportOptions& options) {
    if (options.ranks != nullptr && !options.ranks->is_root()) {
        prepare_for_root(source, grid, outputs, options);
        return std::vector<OutputRecord>(outputs.size());
    }
    std::vector<std::unique_ptr<VoxelSink>> sinks;
    std::vector<BrickSink*> all;
    for (const VoxelOutput& output : outputs) {
        sinks.push_back(make_sink(grid, output, options));
        all.push_back(sinks.back().get());
    }
    stream_bricks(source, all, options.progress, options.ranks);
    std::vector<OutputRecord> records;
    records.reserve(sinks.size());
    for (auto& sink : sinks) {
        sink->close();
    }
    for (auto& sink : sinks) {
        records.push_back(sink->commit());
    }
    return records;
}

Vec3 resolved_voxel_size(const ModelView& view, const ExportOptions& options) {
    const Vec3 side = view.model.frame.to_world_size(view.model.domain.extent.size());
    const double longest = std::max({side.x, side.y, side.z}) / 128;
    const double flattened = std::max(1.0, view.model.frame.z_scale);  // thin voxels where the ground is stretched
    const Vec3 automatic{rounded_1_2_5(longest), rounded_1_2_5(longest), rounded_1_2_5(longest / flattened)};
    Vec3 size = options.voxel_size;
    for (int axis = 0; axis < 3; ++axis) {
        size[axis] = size[axis] == 0 ? automatic[axis] : size[axis];
    }
    return size;
}

}  // namespace terratet
