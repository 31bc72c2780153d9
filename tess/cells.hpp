// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What is known of each cell of a finished model: the table behind VTU cell data, region volumes, voxel masks, and the
/// report's percentages.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tess/model.hpp"

namespace terratet {

/// Columns in step with TetMesh::cells.
struct CellTable {
    std::vector<std::int32_t> region;     ///< fault block, 0…; −1 for gap cells and cells outside the extent
    std::vector<std::int32_t> fault;      ///< fault whose gap the cell fills; −1 otherwise
    std::vector<std::uint8_t> in_extent;  ///< 1 when the centroid lies in the extent, and not beyond
    std::vector<std::uint8_t> beyond;  ///< 1 above the topography, outside the outline of the domain, and in the gaps
                                       ///< of both: no output has such cells
    std::vector<Reason> reason;        ///< why it was left bad; none for good cells
    std::vector<float> radius_edge;
    std::vector<float> aspect;
    std::vector<float> dihedral_min_deg;
    std::int32_t region_count = 0;         ///< regions are numbered by their smallest cell
    std::vector<std::string> region_name;  ///< the model's, or "region N"
};

/// O(n). `mesh` is the model's own.
CellTable describe_cells(const Model& model, const TetMesh& mesh);

/// Does the cell join both sides of one fault and nothing else? Returns the fault, or −1. At junctions other cells
/// between seeds reach across a fault, too: the table counts them as gap cells of that one.
std::int32_t gap_fault(const std::array<std::uint32_t, 4>& cell, std::span<const Vertex> vertices);

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
    double edge_min = 0;  ///< of these cells
    double edge_max = 0;
    std::size_t regions = 0;

    std::size_t below_dihedral = 0;        ///< cells that break a clean-up criterion still
    std::size_t below_dihedral_given = 0;  ///< of these, formed by samples and seeds alone: no vertex may be touched
    std::size_t below_v_min = 0;
};

CellStatistics cell_statistics(const Model& model, const TetMesh& mesh, const CellTable& cells);

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

/// Edges within the extent that cross a fault without both ends being seeds of it or of faults that meet it: F1 says
/// none. Each edge once, as
/// vertex indices, with the fault; an edge counts when its crossing point lies in the extent.
struct CrossingEdge {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::int32_t fault = -1;
};
std::vector<CrossingEdge> fault_crossing_edges(const Model& model, const TetMesh& mesh);

/// How well the tessellation's piecewise linear field agrees with all samples, dropped ones included, in the property's
/// scale. A sample in no cell, or in one with a missing value, does not count.
struct Fidelity {
    double rms = 0;
    double max = 0;
    std::size_t count = 0;
};
std::vector<Fidelity> fidelity(const Model& model, const TetMesh& mesh);  ///< one per property

}  // namespace terratet
