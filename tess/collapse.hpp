// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Faults without width: the gap cells go, both sheets of a fault meet on its surface, and the nodes there are split,
/// as finite-element codes want it (DESIGN §4.2).
///
/// Of paired faults the collapse is a simplicial map of the tessellation: it moves vertices and makes several of them
/// one. Cells with two corners at one place are gone. Such a map changes no covering degree, so when the hull box stays
/// as it is and every other cell keeps a positive volume, the cells tile the hull box as before: nothing overlaps and
/// nothing is missing. What would lose its volume is not moved, so the result is a proper mesh always, and what could
/// not be moved is reported.
///
/// In exact mode nothing moves. The faults' own vertices get nodes among the seeds that stand round them, the gap is
/// filled from these (collapse_fill.hpp), and the rest of it is cut where its edges run through a fault
/// (collapse_cut.cpp): the new cells tile what the old ones did.
///
/// A fault then is a set of facets: those on the sheet between cells of its two sides. Each node is split into as many
/// as there are parts of its star that these facets separate: two on a fault, three or more where faults meet, one on a
/// rim. So twin facets have the same positions by construction. check_conformity() tests all this afresh on each
/// result.

#include <vector>

#include "tess/cells.hpp"
#include "tess/conformity.hpp"
#include "tess/model.hpp"

namespace terratet {

struct CollapseReport {
    std::size_t dropped_cells = 0;  ///< gap cells that are gone, or that others fill
    std::size_t split_places = 0;   ///< places with more than one node
    std::size_t added_places = 0;   ///< where an edge of one sheet crossed one of the other; in exact mode a fault
    double split_area = 0;          ///< of the facets on faults, in the extent, each pair once
    double sheet_area = 0;          ///< of the faults themselves: as much, but for bends, unless a fault has holes now
    std::vector<Vec3> apart;  ///< places on the faults where the sheets could not meet: thin cells stay on the − side
    std::vector<Vec3> aside;  ///< places where, besides, the facets stay off the surface by half the fault's width; in
                              ///< exact mode where an edge through a fault could not be cut, and nodes beside the
                              ///< faults at which regions meet
    Conformity conformity;    ///< with what lies above the ground and outside the outline
};

/// A model's mesh with its faults collapsed, in the shape that writers take.
struct CollapsedModel {
    Model model;   ///< the vertices are nodes here: in the order of their places, those of one place one after the
                   ///< other, their ids unique but not ascending. A node on one side carries its seed's id, owner, side
                   ///< and values, a fault's own vertex the mean of the seeds round it on that side; one on a rim has
                   ///< side 0 and the mean of all its seeds' values
    TetMesh mesh;  ///< split facets have no neighbour
    CellTable
        cells;  ///< fault is −1 where it was collapsed; regions are the same, and have the cells of the gaps as well
    CollapseReport report;
};

enum class Collapsing {
    bounds,  ///< topography and domain alone, at which every output ends; faults and horizons keep their gaps
    all,
};

/// What lies above the ground and outside the outline is not in the result. `mesh` and `cells` are the model's own. O(n
/// log n); as many passes as there are rounds of giving up, few.
CollapsedModel collapse_faults(const Model& model, const TetMesh& mesh, const CellTable& cells,
                               Collapsing which = Collapsing::all);

/// Is there a topography, or a domain's wall, to end at?
bool has_bounds(const Model& model);

}  // namespace terratet
