// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The places of faults where a collapsed tessellation is to have nodes.

#include <cstdint>
#include <vector>

#include "tess/model.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// A place of a fault that is to get a node. With paired seeds these meet at it: a pair halfway, those about a
/// junction's point in that point. In exact mode it is a vertex of the fault itself: the seeds of its triangles stand
/// round it, stay, and it gets a node among them.
struct FaultNode {
    enum class State : std::uint8_t {
        joined,  ///< all seeds at the base; of a fault's vertex: it has its node
        apart,   ///< + seed at the base, − seed where it was; of single pairs only
        aside    ///< all where they were; of a fault's vertex: there is no node
    };
    Vec3 base;
    std::vector<std::uint32_t> seeds;    ///< vertices that are to meet: + and − in turn
    std::vector<std::int32_t> barriers;  ///< that it is on
    std::vector<std::uint32_t> cells;    ///< of a fault's vertex: those that it is put into, ascending
    State state = State::joined;

    [[nodiscard]] bool is_vertex() const { return !cells.empty(); }

    /// Gives up one thing more; false when there is nothing left to give up.
    bool retreat();
};

/// In paired mode those where seeds meet. At a junction with a selected fault the pairs of the others meet as well: a
/// gap that ran on through a wall would leave it nothing to end at.
///
/// In exact mode the vertices of sheets and margins. First those that all the nearest seeds stand round at one
/// distance, so that they are vertices of the Voronoi diagram: their cells are those between these seeds. Then the
/// others: cells between seeds with the vertex in their circumsphere. Only cells that it sees from within count. O(n
/// log n).
std::vector<FaultNode> fault_nodes(const Model& model, const TetMesh& mesh, const std::vector<char>& selected,
                                   const Poll& poll = {});

}  // namespace terratet
