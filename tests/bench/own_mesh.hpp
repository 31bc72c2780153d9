// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Our refinement on the task of peer.hpp.

#include "peer.hpp"
#include "tess/refine/refine.hpp"
#include "tess/refinement.hpp"

namespace terratet::bench {

/// The points, the gridded box and what refinement added, with one property on every vertex.
struct OwnMesh {
    Tessellation tessellation;
    VertexValues values;
    RefineReport report;
    double seconds = 0;         ///< CPU time of all
    double refine_seconds = 0;  ///< of refinement alone
};

/// `face_length` is the longest edge wanted on the faces (face_grid).
OwnMesh refined(const PointsInBox& task, const Criteria& criteria, double face_length, const RefineOptions& options);

/// Limits as TetGen has them, the volume and R/ℓ ≤ 2, and β where `aspect` is not 0. l_max is out of the way.
Criteria volume_criteria(double volume, double aspect);

/// Of the regular tetrahedron.
double edge_of_volume(double volume);

MeshResult measured(const OwnMesh& mesh);

}  // namespace terratet::bench
