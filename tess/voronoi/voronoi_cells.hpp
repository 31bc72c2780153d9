// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model's Voronoi cells: for each vertex what of the model is nearer to it than to any other.
///
/// They end at the extent's sides exactly, and at the ground and the walls of the domain where the cells of those
/// barriers' seeds meet. Faults and horizons run along walls likewise: exactly on them for certified triangles of exact
/// barriers (tess/barrier.hpp), through the middle of each pair of seeds, square to it, in paired mode.

#include "tess/cell_regions.hpp"
#include "tess/model.hpp"
#include "tess/voronoi/voronoi_complex.hpp"

namespace terratet {

struct VoronoiCells {
    VoronoiComplex complex;             ///< frame-local; its cells are numbered as the columns here
    std::vector<std::uint32_t> vertex;  ///< of each cell, ascending. It need not lie in the extent
    std::vector<std::int32_t> region;   ///< of each cell; −1 where it hangs together with none
    std::vector<std::int32_t> barrier;  ///< of each wall: the one that it stands for; else −1
};

/// `mesh`, `regions` and `barriers` are the model's own. O(n), and a query a wall between seeds.
VoronoiCells voronoi_cells(const Model& model, const TetMesh& mesh, const CellRegions& regions,
                           const BarrierQuery& barriers, const Poll& poll = {});

}  // namespace terratet
