// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What is added beyond the rims of a fault, so that the seeds cover more than the surface itself. Without it
/// edges of the tessellation slip round the rims (research: 15 to 125 of them in a small model, at any radius).

#include "tess/base/tri_mesh.hpp"

namespace terratet {

/// Unit normals at the points, evened out along the rim, so that neighbouring directions of extension agree.
std::vector<Vec3> rim_normals(const TriMesh& mesh, const std::vector<RimEdge>& rim);

/// Continues the surface across the extent's faces: rims beyond a face, or nearer than `snap` to it from inside, grow
/// in the tangent direction that heads for the face until they are `reach` beyond it, in rows no farther apart than
/// `spacing`. Rims nearly parallel to their way there, surfaces nearly parallel to the face (below 10°), and strips
/// that would fold are left as they are. Returns the mesh with the strips, cut to the extent grown by `reach`.
TriMesh extended_across(const TriMesh& part, const Box3& extent, double snap, double reach, double spacing);

/// Strips of the given width along the given rim edges of the part, in the surface's tangent planes, with fans at
/// convex corners: with the surface they hold everything tangentially nearer than `width` to it. Rims on the faces of
/// `limit`, where the surface was cut, get none, nor do rims farther than `width` from the extent. Triangles overlap;
/// each carries its normal in its sense. Cut to `limit`.
TriMesh skirt(const TriMesh& part, const std::vector<RimEdge>& rim, double width, const Box3& extent,
              const Box3& limit);

}  // namespace terratet
