// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What is known of each cell of a finished model: the table behind VTU cell data, region volumes, voxel masks, and the
/// report's percentages.

#include <string>
#include <vector>

#include "tess/cell_regions.hpp"
#include "tess/model.hpp"
#include "tess/refinement.hpp"

namespace terratet {

/// Columns in step with TetMesh::cells.
struct CellTable : CellRegions {
    std::vector<Reason> reason;  ///< why it was left bad; none for good cells
    std::vector<float> radius_edge;
    std::vector<float> aspect;
    std::vector<float> dihedral_min_deg;
    std::vector<std::string> region_name;  ///< the model's, or "region N"
};

/// All but the reasons. O(n). `mesh` and `barriers` are the model's own.
CellTable measure_cells(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers);

/// All. O(n), two to three times as long.
CellTable describe_cells(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers);

/// The same; the barriers' queries are made for it alone.
CellTable describe_cells(const Model& model, const TetMesh& mesh);

}  // namespace terratet
