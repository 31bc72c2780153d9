// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Internal: giving a fault triangles of the size of its seed spacing.

#include "tess/fault_mesh.hpp"

namespace terratet {

/// Do the vertices already suit the spacing: nearly all triangles covered within s/√2, and not many more vertices than
/// that takes? Such a mesh, a 20 m grid for s = 20 m, is kept point by point.
bool suits(const FaultMesh& mesh, double spacing);

/// Isotropic triangles of edge length `spacing` (CGAL's isotropic remeshing; corners of the rim stay). Returns the mesh
/// unchanged where that fails, or loses more than a tenth of the area, or strays farther than half the spacing.
/// Deterministic. About 30 µs a vertex.
FaultMesh remeshed(const FaultMesh& mesh, double spacing);

/// Largest distance between two meshes, both ways, at their vertices and centroids that lie within `where`; distances
/// above `limit` count as `limit`.
double deviation(const FaultMesh& a, const FaultMesh& b, const Box3& where, double limit);

struct Rounding {
    bool resolved = true;  ///< no bend is left that is sharper than five spacings
    double steepest = 0;   ///< before: slope of the steepest edge against the tangent plane at its end. Halves with the
                           ///< spacing where the surface is smooth, stays the same at a crease
};

/// Rounds bends sharper than a radius of five spacings, which seeds at that spacing could not follow: points there move
/// along their normals towards their neighbours until every bend is resolved, or for 40 rounds.
Rounding round_bends(FaultMesh& mesh, double spacing);

}  // namespace terratet
