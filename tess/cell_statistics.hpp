// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The report's numbers about cells.

#include <cstddef>
#include <string>
#include <vector>

#include "tess/cells.hpp"

namespace terratet {

/// Numbers of the report over the non-gap cells in the extent (DESIGN §5).
struct CellStatistics {
    std::size_t vertices = 0;
    std::size_t tetrahedra = 0;  ///< all cells of the tessellation
    std::size_t gap_tetrahedra = 0;
    double skinny_percent = 0;  ///< R/ℓ above radius_edge
    double flat_percent = 0;    ///< not skinny, β above aspect
    double bad_percent = 0;     ///< breaks any insertion criterion in force, exempt or not
    double dihedral_min_deg = 0;
    double dihedral_p1_deg = 0;
    double dihedral_p5_deg = 0;
    double dihedral_median_deg = 0;
    double edge_min = 0;  ///< of all cells in the extent, gap cells too
    double edge_max = 0;
    std::size_t regions = 0;

    std::size_t below_dihedral = 0;        ///< cells that break a clean-up criterion still
    std::size_t below_dihedral_given = 0;  ///< of these, formed by samples and seeds alone: no vertex may be touched
    std::size_t below_v_min = 0;
};

CellStatistics cell_statistics(const Model& model, const TetMesh& mesh, const CellTable& cells,
                               const BarrierQuery& barriers);

/// A region without values: of no property, or of these.
struct EmptyBlock {
    std::int32_t region = 0;
    std::string name;
    double volume = 0;                    ///< of its cells, true
    bool of_all = false;                  ///< none of any property that has samples
    std::vector<std::string> properties;  ///< without a value there, of those that have samples
};

/// The regions in none of whose cells a property has values: no sample of it can be seen from there. O(cells).
std::vector<EmptyBlock> empty_blocks(const Model& model, const TetMesh& mesh, const CellTable& cells);

}  // namespace terratet
