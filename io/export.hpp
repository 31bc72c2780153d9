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
/// | .vdb | OpenVDB, one FloatGrid a property | write_vdb |
/// | .csv | vertices with values | write_csv |

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "interp/lattice.hpp"
#include "interp/live_model.hpp"
#include "tess/cells.hpp"
#include "tess/model.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// What every writer sees; all of one model.
struct ModelView {
    const Model& model;
    const TetMesh& mesh;
    const CellTable& cells;
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

struct ExportOptions {
    std::string format;  ///< overrides the extension: VTU, GLTF, HTML, PNG, VDB, CSV
    bool overwrite = false;
    FaultGap fault_gap = FaultGap::keep;
    bool clip = false;          ///< VTU: only cells in the extent, cut at its planes
    bool compress = false;      ///< VTU: zlib blocks; glTF: meshopt, 16 bits an axis
    Vec3 voxel_size{0, 0, 0};   ///< 0: the extent's longest side / 128, over the frame's z_scale in z, rounded to
                                ///< 1-2-5
    bool local_origin = false;  ///< VDB: grid in frame-local coordinates, for float-based tools
    // Of scenes (glTF, HTML, PNG):
    std::string color_property;  ///< which property colours the scene; empty: the first
    std::string color_map = "viridis";
    std::vector<Section> sections;  ///< none: two through the middle of the samples
    std::vector<IsoLevels> iso;     ///< none: at the quartiles of the property that colours the scene
    bool enu = false;               ///< glTF: east, north and up on the globe instead of the grid's offsets
    std::array<std::uint32_t, 2> picture_size{1600, 1000};  ///< PNG: width and height
    std::string title;                                      ///< HTML, PNG; empty: the name of the file
    std::string made_by;                                    ///< HTML: the program, and how one comes to such a model
    std::optional<double> max_extrapolation;                ///< scenes: grey beyond; none: where no sample reaches
    Progress progress;
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

struct OutputRecord {
    std::string path;
    std::uint64_t bytes = 0;
    std::optional<ClippedShapes> clipped = {};  ///< of a clipped VTU
};

/// Dispatches by extension or options.format. Every format ends at the ground and at the domain's walls, which have no
/// width then. Throws UsageError for an unknown format (lists those there are), Error when a mesh without gaps fails
/// its check.
OutputRecord export_model(const ModelSnapshot& model, const std::string& path, const ExportOptions& options = {});
inline OutputRecord export_model(const LiveModel& model, const std::string& path, const ExportOptions& options = {}) {
    return export_model(*model.snapshot(), path, options);
}

/// A view as it is, whatever it shows.
OutputRecord export_model(const ModelView& view, const std::string& path, const ExportOptions& options);

/// How many faults an output of that format shows without width: all, none but the bounds, or none at all.
std::optional<Collapsing> collapsing(const Model& model, const std::string& format, FaultGap gap);

/// The format that a path would get, upper case; throws UsageError as export_model does. For checks before any work.
std::string output_format(const std::string& path, const std::string& override_format = {});

OutputRecord write_vtu(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_gltf(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_html(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_png(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_vdb(const ModelView& view, const std::string& path, const ExportOptions& options);
OutputRecord write_csv(const ModelView& view, const std::string& path, const ExportOptions& options);

/// Of each region within the extent, cut exactly at its planes, in the cube of the model's unit. Gap cells are no
/// region's: for volumes that add up to the extent's, collapse the faults before. O(cells).
std::vector<double> region_volumes(const ModelView& view);

/// The voxel size in force for a view: the given one, or the default.
Vec3 resolved_voxel_size(const ModelView& view, const ExportOptions& options);

}  // namespace terratet
