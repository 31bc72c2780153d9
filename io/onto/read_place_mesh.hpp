// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Other people's meshes from their files.

#include <string>

#include "io/onto/place_mesh.hpp"
#include "io/source.hpp"

namespace terratet {

/// Is the file one of a mesh, by its extension: .vtu or .msh?
bool names_mesh(const std::string& path);

/// VTK's XML unstructured grid (text, base64 or appended; plain or zlib), all its pieces together, or Gmsh's 2.2 or 4.1
/// as text. Throws InputError: missing, damaged, of another kind, with a node that is not there, without a node.
PlaceMesh read_place_mesh(const Source& source);

}  // namespace terratet
