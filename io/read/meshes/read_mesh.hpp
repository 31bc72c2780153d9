// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Triangle meshes of modelling programs, told apart by their content. Each reader holds the file in memory, checks
/// counts against its size before it allocates, and takes time in proportion to it.
///
/// | format | objects | notes |
/// |---|---|---|
/// | Wavefront OBJ | o and g | v, f with or without / and negative indices; lines, points, materials are left |
/// | PLY | one | ascii, binary of either end; other elements are skipped |
/// | STL | solid | ascii, binary; corners at the same position are one vertex |
/// | OFF | one | with or without normals, colours, counts on the first line |
/// | VTP (VTK PolyData) | one | ascii, base64, raw appended; zlib or none; either end; polygons and strips |
/// | DXF | layer | 3DFACE, polyface and mesh POLYLINE, in ENTITIES; ascii, binary |
/// | Irap classic grid | one | ascii, binary; nodes of 9999900 and more are none |

#include <optional>
#include <string>
#include <vector>

#include "tess/diagnostics.hpp"
#include "tess/surface.hpp"

namespace terratet {

enum class MeshFormat { obj, ply, stl, off, vtp, dxf, irap };

/// Looks at the first bytes, and at the name for OBJ. nullopt for anything else and for what cannot be opened.
std::optional<MeshFormat> mesh_format(const std::string& path);

/// Faces that are damaged are rejected with their line or number. Throws InputError: cannot be read, above 2 GiB,
/// damaged so that the rest cannot be found, no usable triangle.
std::vector<Surface> read_mesh(const std::string& path, MeshFormat format, SurfaceKind kind, Diagnostics& diagnostics);

}  // namespace terratet
