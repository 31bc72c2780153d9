// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What writers are given, and what they tell.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interp/model_estimator.hpp"
#include "tess/cells.hpp"
#include "tess/model.hpp"
#include "tess/progress.hpp"

namespace terratet {

class Ranks;

/// What every writer sees; all of one model.
struct ModelView {
    const Model& model;
    const TetMesh& mesh;
    const CellTable& cells;
    const ModelEstimator* estimator = nullptr;  ///< of the model, where voxels are to have its values
    const BarrierQuery* barriers = nullptr;     ///< of the model; null: whoever wants them makes them
};

enum class FaultGap {
    keep,      ///< the cells between a fault's two sheets
    collapse,  ///< VTU and glTF: none; the sheets meet on the fault, whose nodes are split (tess/collapse.hpp)
};

/// A plane through the model to look at, in true coordinates; upright or level.
struct Section {
    std::string name;
    Vec3 point;
    Vec3 normal;                                ///< of unit length
    std::optional<std::array<Vec3, 2>> ends{};  ///< in plan: only between these
};

/// From "x1,y1,x2,y2" (upright between two places), "z=V" (level) or "AZIMUTH,x,y" (upright through a place, running
/// that way, degrees from grid north). Throws UsageError.
Section parse_section(const std::string& text);

/// Where to draw a property's isosurfaces.
struct IsoLevels {
    std::string property;
    std::vector<double> values;  ///< measured
};

/// From "PROPERTY=VALUE[,VALUE]". Throws UsageError.
IsoLevels parse_iso(const std::string& text);

/// What a voxel's value is.
enum class VoxelValues {
    linear,     ///< the tessellation's linear field at its centre
    estimator,  ///< what all samples say there, as ModelSnapshot::estimator() has it
};

struct ExportOptions {
    std::string format;  ///< overrides the extension: one of export_format_names()
    bool overwrite = false;
    FaultGap fault_gap = FaultGap::keep;
    bool margin = false;   ///< VTU: all cells of the hull box, uncut; else those in the extent, cut at its planes
    bool voronoi = false;  ///< VTU: the Voronoi cells of the vertices instead of the tetrahedra
    std::optional<bool> compress;  ///< each format has its own default: VTU, GeoTIFF and netCDF do
    Vec3 voxel_size{0, 0, 0};      ///< 0: the extent's longest side / 128, over the frame's z_scale in z, rounded to
                                   ///< 1-2-5
    VoxelValues voxel_values = VoxelValues::linear;
    std::optional<double> max_extrapolation;  ///< voxels: beyond it no property has values; scenes: grey beyond
    bool aligned = true;         ///< voxels: their edges are multiples of their size on the map; else they are centred
    bool allow_large = false;    ///< voxels: also more than large_output bytes
    bool msh_version_2 = false;  ///< Gmsh: version 2.2 of its format instead of 4.1
    std::string vertical_crs;    ///< tilesets: EPSG code of the heights, where the model's system says none
    bool half = false;           ///< VDB: 16-bit floats
    bool all_fields = false;     ///< GeoTIFF: bands for extrapolation and region too
    bool cog = false;            ///< GeoTIFF: cloud-optimised
    bool local_origin = false;   ///< VDB: grid in frame-local coordinates, for float-based tools
    // Of scenes (glTF, HTML, PNG):
    std::string color_property;  ///< which property colours the scene; empty: the first
    std::string color_map = "viridis";
    std::vector<Section> sections;  ///< none: two through the middle of the samples
    std::vector<IsoLevels> iso;     ///< none: at the quartiles of the property that colours the scene
    bool enu = false;               ///< glTF: east, north and up on the globe instead of the grid's offsets
    std::array<std::uint32_t, 2> picture_size{1600, 1000};  ///< PNG: width and height
    std::string title;                                      ///< HTML, PNG; empty: the name of the file
    std::string made_by;                                    ///< HTML: the program, and how one comes to such a model
    Progress progress;
    const Ranks* ranks = nullptr;  ///< voxels: all of them make bricks (interp/ranks/ranks.hpp), rank 0 writes
};

/// Shapes of the cells of a clipped mesh but those in gaps, in the frame's unit: with its z-scale.
struct ClippedShapes {
    std::size_t cells = 0;
    double dihedral_min_deg = 0;
    double dihedral_p1_deg = 0;
    double edge_min = 0;
    std::size_t below_1_deg = 0;
    std::size_t below_10_deg = 0;
    std::size_t short_edges = 0;  ///< cells with one below a tenth of l_min
    /// Of those below 10° or with a short edge: cells at a kept sample, else at a fault, the ground or a wall, whose
    /// points stay where they are; else those that the tessellation had; others.
    std::size_t at_sample = 0;
    std::size_t at_fault = 0;
    std::size_t as_tessellated = 0;
    std::size_t other = 0;
};

/// Above so many bytes an output of voxels has to be asked for (ExportOptions::allow_large).
inline constexpr std::uint64_t large_output = std::uint64_t{2} << 30;

struct OutputRecord {
    std::string path;
    std::uint64_t bytes = 0;
    std::optional<ClippedShapes> clipped = {};  ///< of a clipped VTU
    std::string remark = {};                    ///< what a user should know of it
};

/// What an output of voxels will take.
struct VoxelPlan {
    std::string path;
    std::array<std::int64_t, 3> voxels{};
    Vec3 voxel_size;          ///< in the map's unit
    std::uint64_t bytes = 0;  ///< at most: neither compressed, nor without what is empty
};

/// The voxel size in force for a view: the given one, or the default.
Vec3 resolved_voxel_size(const ModelView& view, const ExportOptions& options);

}  // namespace terratet
