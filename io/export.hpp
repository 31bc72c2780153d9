// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Writers. Each takes the same view of a finished model and produces one file, whole or not at all, deterministic to
/// the byte. docs/outputs.md describes what each contains.
///
/// | extension | format | writer |
/// |---|---|---|
/// | .vtu | VTK unstructured grid, appended raw | write_vtu |
/// | .glb .gltf | glTF 2.0 scene | write_gltf |
/// | .html | a page to look at the scene with | write_html |
/// | .png | a picture of the scene | write_png |
/// | .vtm | the mesh, boreholes and barriers for VTK, in a folder | write_vtm |
/// | .msh | Gmsh, with physical names | write_msh |
/// | .pvd | a VTU a time, in a folder | write_pvd |
/// | .uge | PFLOTRAN, Voronoi cells and their connections; more in a folder | write_uge |
/// | .ugi | PFLOTRAN, tetrahedra; more in a folder | write_ugi |
/// | .ts .obj, .gpkg as SURFACES | barriers, ground and isosurfaces | write_surfaces |
/// | .vtu as OGS | OpenGeoSys; boundaries and barriers in a folder | write_ogs |
/// | .csv | vertices with values | write_csv |
/// | .vdb | OpenVDB, a grid a property | voxels |
/// | .tif | GeoTIFF or COG, a band a slice | voxels |
/// | .nc | CF netCDF cube | voxels |
/// | .csv as BLOCKS | block model | voxels |
/// | .json as TILES | 3D Tiles of the scene, in a folder | write_surface_tiles |
/// | .json as VOXELTILES | 3D Tiles of voxels, in a folder | voxels |

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "interp/lattice.hpp"
#include "interp/live_model.hpp"
#include "io/export_options.hpp"

namespace terratet {

/// Dispatches by extension or options.format. Every format ends at the ground and at the domain's walls, which have no
/// width then. Throws UsageError for an unknown format (lists those there are), Error when a mesh without gaps fails
/// its check.
OutputRecord export_model(const ModelSnapshot& model, const std::string& path, const ExportOptions& options = {});
inline OutputRecord export_model(const LiveModel& model, const std::string& path, const ExportOptions& options = {}) {
    return export_model(*model.snapshot(), path, options);
}

/// One of several outputs.
struct OutputRequest {
    std::string path;
    std::string format = {};  ///< overrides the extension, and ExportOptions::format
};

/// Several at once: those of voxels share one pass over the lattice, so that together they cost little more than the
/// slowest alone. Records are in step with requests. An error leaves those outputs that were finished before.
std::vector<OutputRecord> export_model(const ModelSnapshot& model, std::span<const OutputRequest> outputs,
                                       const ExportOptions& options);

/// Of those outputs that are voxels. Throws UsageError for more than large_output bytes unless options.allow_large.
std::vector<VoxelPlan> plan_voxels(const ModelView& view, std::span<const OutputRequest> outputs,
                                   const ExportOptions& options);

/// Does the format consist of voxels? \pre output_format() returned it.
bool is_voxel_format(const std::string& format);

/// A view as it is, whatever it shows.
OutputRecord export_model(const ModelView& view, const std::string& path, const ExportOptions& options);

/// How many faults an output of that format shows without width: all, none but the bounds, or none at all, as
/// Voronoi cells do.
std::optional<Collapsing> collapsing(const Model& model, const std::string& format, const ExportOptions& options);

/// The format that a path would get, upper case; throws UsageError as export_model does. For checks before any work.
std::string output_format(const std::string& path, const std::string& override_format = {});

/// For people: the extensions that tell a format, and the formats' names; a tileset's .json is no format's alone.
std::string export_extensions();
std::string export_format_names();

OutputRecord write_vtu(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_gltf(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_html(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_png(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_vtm(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_msh(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_pvd(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_uge(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_ugi(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_ogs(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_surfaces(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_surface_tiles(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_csv(const ModelView& view, const std::string& path, const ExportOptions& options);

/// Of each region within the extent, cut exactly at its planes, in the cube of the model's unit. Gap cells are no
/// region's: for volumes that add up to the extent's, collapse the faults before. O(cells).
std::vector<double> region_volumes(const ModelView& view);

}  // namespace terratet
