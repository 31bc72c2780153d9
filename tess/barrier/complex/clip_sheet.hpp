// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cutting a mesh where a function given at its points changes sign; planes are the simplest case.

#include <span>

#include "tess/base/tri_mesh.hpp"

namespace terratet {

struct MendableMesh {
    TriMesh above;  ///< where the level is positive
    TriMesh below;
};

/// Cuts along the zero line of the function that is linear on each triangle and has the given value at each point. Each
/// half keeps its triangles' sense and stays connected: neighbours share the new points on their edge.
MendableMesh cut_at_zero(const TriMesh& mesh, std::span<const double> level);

/// The same for the plane x[axis] = at; above is where x[axis] is larger. New points lie exactly on the plane.
MendableMesh cut_at_plane(const TriMesh& mesh, int axis, double at);

/// What lies inside a box and what outside.
struct BoxCut {
    TriMesh inside;
    TriMesh outside;
};
BoxCut cut_to_box(TriMesh mesh, const Box3& box);

}  // namespace terratet
