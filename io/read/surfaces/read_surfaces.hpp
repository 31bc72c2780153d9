// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Surfaces from files, one reader per format, dispatched by content (docs/input-surfaces.md):
///
/// | format | reader | notes |
/// |---|---|---|
/// | GOCAD TSurf (.ts) | read_tsurf | own parser; several objects and TFACEs a file, ZPOSITIVE, units |
/// | OBJ, PLY, STL, OFF, VTP, DXF, Irap grid | read_mesh | io/read/meshes |
/// | lines with dips, sticks | read_traces | any OGR layer of lines |
/// | raster of heights | read_raster_surface | GeoTIFF, ASCII grid, ZMap, … |
/// | TIN Z, PolyhedralSurface Z, MultiPolygon Z, Polygon Z | read_ogr_surfaces | any OGR layer; features of one name
/// joined | | points x, y, z and fault name | read_fault_points | any table; triangulated in the best-fit plane |

#include <string>
#include <vector>

#include "io/base/crs.hpp"
#include "io/read/tables/read_table.hpp"
#include "io/site_inputs.hpp"
#include "io/source.hpp"
#include "tess/diagnostics.hpp"
#include "tess/surface.hpp"

namespace terratet {

/// Surfaces in the coordinates of the file, with the CRS the file states (empty when it states none).
struct RawSurfaces {
    std::vector<Surface> surfaces;
    Crs crs;
    bool z_stated = false;  ///< the file itself says which way z counts, or it is made here
};

/// What a user says of surfaces beside their columns.
struct SurfaceOptions {
    ZPositive z_positive = ZPositive::automatic;
    std::string fault_depth{};  ///< SiteInputs::fault_depth
};

/// Dispatches. Triangles with an index out of range, too few corners or unacceptable coordinates are rejected into
/// `diagnostics` with their line; throws InputError when nothing usable is left or the file is not of a known kind.
/// Heights that count downwards by `options` come turned over, but for files that say themselves.
RawSurfaces read_surfaces(const Source& source, SurfaceKind kind, const ColumnNames& columns, Diagnostics& diagnostics,
                          const SurfaceOptions& options = {});

/// Is this a GOCAD file? Looks at its first line. False also for what cannot be opened.
bool is_gocad(const std::string& path);

/// One surface a TSurf object, its TFACEs joined; of VSet and PLine objects one as of points. Others are noted.
/// Vertices stay as they are in the file, in its order. When the file states a length unit, coordinates come in the
/// unit of `source.srs`, or in metres when that is empty; so a caller that has a CRS for the file puts it there. Memory
/// is a small multiple of the file's size.
RawSurfaces read_tsurf(const Source& source, SurfaceKind kind, Diagnostics& diagnostics);

/// One surface for all features of a name (a column such as NAME, FAULT, SURFACE, or LAYER as in converted drawings).
/// Without such a column: one a feature, or one a layer when its features are single polygons. Corners at equal
/// positions become one vertex; vertices are sorted by coordinates, triangles start with their smallest vertex and are
/// sorted, so that the order of features does not matter. Polygons of more than three corners are triangulated. Throws
/// InputError: no z, no polygons.
RawSurfaces read_ogr_surfaces(const Source& source, SurfaceKind kind, const ColumnNames& columns,
                              Diagnostics& diagnostics);

/// Can GDAL read this as a raster? Looks at its content. False also for what cannot be opened.
bool is_raster(const std::string& path);

/// One surface for the first band's heights, named after the file: a grid of the pixels' centres, and of the raster's
/// border, to which heights are continued linearly. Pixels without a height leave a hole. Scale and offset of the band
/// apply; heights are in the unit of the CRS. Rasters of more than 250 000 pixels are averaged into fewer, and a note
/// says so.
RawSurfaces read_raster_surface(const Source& source, SurfaceKind kind, Diagnostics& diagnostics);

/// One surface for all points of a name, or for the whole file without a name column, sorted by name; triangulated in
/// their best-fit plane, in metres also for longitude and latitude (said by the file or by `source.srs`). Points
/// without three coordinates are rejected, and so are points that are no graph over that plane. With a column of sticks
/// (STICK, STICK_ID, …) the points of a stick are a line, in the order of rows, joined with the next stick's. A column
/// called depth counts downwards.
RawSurfaces read_fault_points(const Source& source, SurfaceKind kind, const ColumnNames& columns,
                              const SurfaceOptions& options, Diagnostics& diagnostics);

/// Of lines: one surface for all traces of a name, from the line down along its dip to the lower depth of its record or
/// of the options, or to the detachment whose file these name; or, without a column of dips, for lines in space one
/// behind the other (sticks). docs/input-surfaces.md. Traces without dip, direction or depth are rejected by record.
/// Throws InputError that says "dip" when no column does.
RawSurfaces read_traces(const Source& source, SurfaceKind kind, const ColumnNames& columns,
                        const SurfaceOptions& options, Diagnostics& diagnostics);

/// The polygons of a layer as one surface of kind domain, named after the layer: their union in plan, z dropped, holes
/// and all. What crosses itself is repaired by GDAL's MakeValid, and a note says so. Throws InputError: no polygons.
RawSurfaces read_domain(const Source& source, Diagnostics& diagnostics);

}  // namespace terratet
