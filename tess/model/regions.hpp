// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which part of the ground a cell belongs to: the gap of a barrier, a region between them, or what lies outside.

#include <cstdint>
#include <span>

#include "tess/barrier_query.hpp"
#include "tess/cell_regions.hpp"
#include "tess/domain.hpp"
#include "tess/mesh/mesh_walk.hpp"
#include "tess/tet_mesh.hpp"

namespace terratet {

/// Regions are the connected components of the extent without the gap cells. O(n), but where seeds of several barriers
/// stand together.
/// \pre `vertices` are in step with the mesh's points.
CellRegions regions(const TetMesh& mesh, std::span<const Vertex> vertices, const BarrierQuery& barriers,
                    const Domain& domain);

/// The region of the cell that holds a point; of one without, as its centroid is beyond the extent, that of the nearest
/// cells that it hangs together with. −1 for a point in a gap or outside. Starts from the last one asked for.
class RegionFinder {
  public:
    RegionFinder(const TetMesh& mesh, const CellRegions& regions) : walk_(mesh), mesh_(mesh), regions_(regions) {}
    std::int32_t at(const Vec3& p);

  private:
    MeshWalk walk_;
    const TetMesh& mesh_;
    const CellRegions& regions_;
};

}  // namespace terratet
