// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Surfaces from files, one reader per format, dispatched by content:
///
/// | format | reader | notes |
/// |---|---|---|
/// | GOCAD TSurf (.ts) | read_tsurf | own parser; several objects and TFACEs a file, ZPOSITIVE, units |
/// | TIN Z, PolyhedralSurface Z, MultiPolygon Z, Polygon Z | read_ogr_surfaces | any OGR layer; one surface a feature |
/// | points x, y, z and fault name | read_fault_points | any table; triangulated in the best-fit plane |

#include <vector>

#include "io/crs.hpp"
#include "io/source.hpp"
#include "tess/diagnostics.hpp"
#include "tess/surface.hpp"

namespace terratet {

/// Surfaces in the coordinates of the file, with the CRS the file states (empty when it states none).
struct RawSurfaces {
    std::vector<Surface> surfaces;
    Crs crs;
};

/// Dispatches. Triangles with an index out of range, too few corners or unacceptable coordinates are rejected into
/// `diagnostics` with their line; throws InputError when nothing usable is left or the file is not of a known kind.
RawSurfaces read_surfaces(const Source& source, SurfaceKind kind,
                          const std::vector<std::pair<std::string, std::string>>& columns, Diagnostics& diagnostics);

/// Is this a GOCAD file? Looks at its first line.
bool is_gocad(const std::string& path);

RawSurfaces read_tsurf(const Source& source, SurfaceKind kind, Diagnostics& diagnostics);
RawSurfaces read_ogr_surfaces(const Source& source, SurfaceKind kind, Diagnostics& diagnostics);
RawSurfaces read_fault_points(const Source& source, SurfaceKind kind,
                              const std::vector<std::pair<std::string, std::string>>& columns, Diagnostics& diagnostics);

}  // namespace terratet
