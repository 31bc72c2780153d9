// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Grids that people have already, as a source of bricks for any writer of voxels: GeoTIFF and netCDF cubes by GDAL,
/// OpenVDB, tables of places and values. Read once into a spill file; memory follows the bricks in flight, for tables
/// the values.

#include <memory>
#include <string>

#include "interp/voxels/bricks.hpp"
#include "io/source.hpp"
#include "io/voxels/tiles/voxel_pyramid.hpp"
#include "io/voxels/voxel_grid.hpp"

namespace terratet {

/// What a reader makes.
struct GridContents {
    VoxelGrid grid;
    std::unique_ptr<VoxelPyramid> blocks;  ///< one level of one field a layer
};

class GridSource final : public BrickSource {
  public:
    explicit GridSource(GridContents contents);

    [[nodiscard]] const VoxelGrid& grid() const { return contents_.grid; }
    [[nodiscard]] const Lattice& lattice() const override { return lattice_; }
    [[nodiscard]] std::size_t fields() const override { return contents_.grid.layers.size(); }
    void fill(Brick& brick) const override;

  private:
    GridContents contents_;
    Lattice lattice_;
};

/// Is the path one of a grid, by its extension?
bool names_grid(const std::string& path);

/// \param srs    of a grid that says none; may be empty
/// \param spill  a path in whose folder what was read is kept meanwhile
/// Throws InputError: not to be opened, not regular, or without heights.
std::unique_ptr<GridSource> read_grid(const Source& source, const std::string& srs, const std::string& spill);

// Of each kind.
GridContents read_raster_cube(const Source& source, const std::string& spill);
GridContents read_vdb_grids(const Source& source, const std::string& spill);
GridContents read_table_grid(const Source& source, const std::string& spill);

/// A layer by the name, unit and classes that a file tells.
VoxelLayer grid_layer(const std::string& name, const std::string& unit, bool categorical, bool log10,
                      std::vector<std::string> classes);

/// Sets the frame's system and unit by a WKT. For axes in degrees heights are metres.
void set_grid_crs(const std::string& wkt, VoxelGrid& grid);

/// An empty store for the grid's layers. \pre size and layers are set.
std::unique_ptr<VoxelPyramid> make_blocks(const VoxelGrid& grid, const std::string& spill);

}  // namespace terratet
