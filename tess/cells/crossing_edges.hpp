// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Does guarantee F1 hold?

#include <cstdint>
#include <vector>

#include "tess/model.hpp"

namespace terratet {

/// Edges within the extent that cross a fault without both ends being seeds of it or of faults that meet it: F1 says
/// none. Each edge once, as
/// vertex indices, with the fault; an edge counts when its crossing point lies in the extent.
struct CrossingEdge {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    std::int32_t barrier = -1;
};
std::vector<CrossingEdge> fault_crossing_edges(const Model& model, const TetMesh& mesh, const BarrierQuery& barriers);

}  // namespace terratet
