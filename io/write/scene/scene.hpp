// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What stands in the scene, before any byte of a format: page, glTF and picture are made from it. Coordinates are
/// the scene frame's (scene_frame.hpp): metres, y up.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/export.hpp"
#include "io/write/scene/coloring.hpp"
#include "io/write/scene/scene_cells.hpp"
#include "io/write/scene/scene_frame.hpp"

namespace terratet {

/// Triangles or lines to draw as one node. Columns in step with positions.
struct ScenePart {
    enum class Kind : std::uint8_t { section, isosurface, ground, block, barrier, borehole, frame };

    std::string name;
    Kind kind = Kind::section;
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;  ///< empty: not lit, its colours are the legend's
    std::vector<Triangle> triangles;
    std::vector<std::array<std::uint32_t, 2>> lines;
    std::vector<std::vector<double>> values;  ///< [property], measured units; empty: no values here
    std::vector<double> extrapolation;        ///< of sections
    std::vector<double> depth;                ///< along the hole, in the model's unit; of boreholes
    std::vector<Color> colors;                ///< empty: `color` throughout
    Color color{1, 1, 1};
    double opacity = 1;
    std::int64_t feature = -1;  ///< which hole, barrier or block of the model's it is
    std::uint32_t sides = 0;    ///< of boreholes: positions are rings of so many, from one end of the tube to the other
    std::string property;       ///< of isosurfaces
    double level = missing;     ///< of isosurfaces, measured
};

struct Scene {
    SceneFrame frame;
    Coloring coloring;
    SceneCells cells;
    std::vector<ScenePart> parts;      ///< each with something to draw, in order: sections, isosurfaces, ground,
                                       ///< blocks, barriers, boreholes, frame
    std::vector<double> block_volume;  ///< of each region, in the cube of the model's unit
};

/// By default two sections through the middle of the samples and isosurfaces at the quartiles of the coloured property;
/// in a model without properties the sections show the fault blocks. Throws UsageError for sections, properties or
/// levels that there are not.
Scene make_scene(const ModelView& view, const ExportOptions& options, ClippedCells cells = ClippedCells::mended);

// ---- its pieces

/// Where the cells of the scene meet one section's plane, as far as the section goes.
ScenePart section_part(const SceneCells& cells, const Section& section, const Coloring& coloring,
                       const SceneFrame& frame, double max_extrapolation);
/// East–west and north–south through the middle of the samples, or of the extent without any.
std::vector<Section> default_sections(const Model& model);

/// A level of a property, in its scale.
struct IsoLevel {
    std::size_t property = 0;
    double scaled = 0;
};
/// Those asked for, or the quartiles of what is coloured. Throws UsageError for properties or levels there are not.
std::vector<IsoLevel> iso_levels(const Model& model, const ExportOptions& options, const Coloring& coloring);
/// As far as samples reach, or max_extrapolation lets it.
CutTriangles isosurface(const SceneCells& cells, const IsoLevel& level, const ExportOptions& options);

std::vector<ScenePart> isosurface_parts(const SceneCells& cells, const ExportOptions& options, const Coloring& coloring,
                                        const SceneFrame& frame);

/// "ground", if there is a topography, and where there are several fault blocks the closed surface of each.
std::vector<ScenePart> surface_parts(const SceneCells& cells, const ModelView& view, const SceneFrame& frame);

/// A prepared surface's sheet as far as the model goes, frame-local.
struct ClippedSheet {
    std::vector<Vec3> places;
    std::vector<Triangle> triangles;
};
ClippedSheet clipped_sheet(const Model& model, std::size_t barrier);

/// A prepared fault's or horizon's sheet, as far as the model goes.
ScenePart barrier_part(const Model& model, std::size_t index, const SceneFrame& frame);

/// Each borehole as a tube in the colours of its own samples.
std::vector<ScenePart> borehole_parts(const ModelView& view, const Coloring& coloring, const SceneFrame& frame);

/// The edges of the extent, or of the domain over its outline.
ScenePart frame_part(const Model& model, const SceneFrame& frame);

/// Of each vertex the mean of its triangles' normals, weighted by area, of unit length.
std::vector<Vec3> vertex_normals(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles);

}  // namespace terratet
