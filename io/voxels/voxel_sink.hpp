// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Writers of voxels: each takes the bricks of a grid as they come (interp/voxels/bricks.hpp) and makes one file of
/// them, whole or not at all. What they keep in memory follows the file's table of contents, not the lattice.

#include <memory>
#include <string>

#include "interp/voxels/bricks.hpp"
#include "io/export_options.hpp"
#include "io/voxels/voxel_grid.hpp"

namespace terratet {

class VoxelSink : public BrickSink {
  public:
    /// After the last brick, once: the file is complete, under its temporary name.
    virtual void close() = 0;
    /// The output under its name.
    [[nodiscard]] virtual OutputRecord commit() = 0;
};

/// Each throws Error as OutputFile does. \pre `grid` outlives the sink.
std::unique_ptr<VoxelSink> make_vdb_sink(const VoxelGrid& grid, const std::string& path, const ExportOptions& options);
std::unique_ptr<VoxelSink> make_geotiff_sink(const VoxelGrid& grid, const std::string& path,
                                             const ExportOptions& options);
std::unique_ptr<VoxelSink> make_netcdf_sink(const VoxelGrid& grid, const std::string& path,
                                            const ExportOptions& options);
std::unique_ptr<VoxelSink> make_tiles_sink(const VoxelGrid& grid, const std::string& path,
                                           const ExportOptions& options);
std::unique_ptr<VoxelSink> make_blocks_sink(const VoxelGrid& grid, const std::string& path,
                                            const ExportOptions& options);

}  // namespace terratet
