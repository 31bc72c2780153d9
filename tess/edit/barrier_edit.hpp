// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A fault into a tessellation and out again (paper: faults are inserted and removed on the fly), without building it
/// anew.
///
/// Guarantee F3: inserting a fault and taking it out again, with the change that the insertion returned, restores the
/// same tessellation: vertices, ids, values and cells.

#include "tess/barrier_query.hpp"
#include "tess/domain.hpp"
#include "tess/edit/exchange.hpp"
#include "tess/refinement.hpp"
#include "tess/tessellation.hpp"
#include "tess/value_source.hpp"

namespace terratet {

/// What an insertion changed: enough to undo it, and to store.
struct BarrierChange {
    ValuedVertices removed;          ///< samples and inserted vertices that stood in the fault's protection zone
    std::vector<std::uint64_t> ids;  ///< of the fault's seeds, ascending
};

/// Inserts the seeds of a fault, its number being their owner, after taking out what it protects itself from: samples
/// and inserted vertices nearer than its protection radius. Other faults' seeds and the hull box's vertices stay. Seeds
/// where a vertex stands already are left out, as are those outside the hull box. The work is local but for
/// renumbering: O(n). \pre values are in step with the tessellation; the fault was prepared for this domain and is not
/// in yet.
BarrierChange insert_barrier(Tessellation& tessellation, VertexValues& values, const Domain& domain,
                             const Barrier& barrier, std::int32_t number, const ValueSource& source);

/// Undoes an insertion (F3), whatever else was inserted or taken out meanwhile.
/// \pre The change's seeds are there, and nothing else has taken the places of what it removed.
void take_out_barrier(Tessellation& tessellation, VertexValues& values, const BarrierChange& change);

}  // namespace terratet
