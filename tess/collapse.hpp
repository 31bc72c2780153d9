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

#include "tess/barrier_query.hpp"
#include "tess/collapsed_model.hpp"
#include "tess/progress.hpp"

namespace terratet {

enum class Collapsing {
    bounds,  ///< topography and domain alone, at which every output ends; faults and horizons keep their gaps
    all,
};

/// What lies above the ground and outside the outline is not in the result. `mesh`, `cells` and `barriers` are the
/// model's own. O(n log n); as many passes as there are rounds of giving up, few. Progress goes by the stages
/// `collapse faults` and `mend cells`.
CollapsedModel collapse_faults(const Model& model, const TetMesh& mesh, const CellTable& cells,
                               const BarrierQuery& barriers, Collapsing which = Collapsing::all,
                               const Progress& progress = {});

/// The same, with the model's barriers made for it.
CollapsedModel collapse_faults(const Model& model, const TetMesh& mesh, const CellTable& cells,
                               Collapsing which = Collapsing::all, const Progress& progress = {});

/// Is there a topography, or a domain's wall, to end at?
bool has_bounds(const Model& model);

}  // namespace terratet
