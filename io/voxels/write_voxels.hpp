// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Voxels in one pass to any number of files.

#include <span>
#include <string>
#include <vector>

#include "interp/voxels/bricks.hpp"
#include "io/export_options.hpp"
#include "io/voxels/voxel_grid.hpp"

namespace terratet {

struct VoxelOutput {
    std::string path;
    std::string format;  ///< VDB, GTIFF, COG, NETCDF, BLOCKS, VOXELTILES
};

/// Throws UsageError for a lattice that is too large, or larger than is usual without options.allow_large.
VoxelPlan plan_voxels(const ModelView& view, const VoxelOutput& output, const ExportOptions& options);

/// In step with outputs: all or none. With options.ranks each rank calls it; those but 0 leave nothing behind, and what
/// they return says nothing.
std::vector<OutputRecord> write_voxels(const ModelView& view, std::span<const VoxelOutput> outputs,
                                       const ExportOptions& options);

/// Of any source. \pre grid.layers are the source's fields.
std::vector<OutputRecord> write_voxels(const BrickSource& source, const VoxelGrid& grid,
                                       std::span<const VoxelOutput> outputs, const ExportOptions& options);

/// Throws UsageError when an output of so many voxels and fields would take more than large_output bytes.
VoxelPlan plan_voxels(const VoxelGrid& grid, const VoxelOutput& output, const ExportOptions& options);

}  // namespace terratet
