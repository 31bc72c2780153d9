// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Cells between the two seed sheets of a barrier.

#include <span>

#include "tess/tet_mesh.hpp"

namespace terratet {

/// Does the cell join both sides of one fault and nothing else? Returns the fault, or −1. At junctions other cells
/// between seeds reach across a fault, too: the table counts them as gap cells of that one.
std::int32_t gap_barrier(const std::array<std::uint32_t, 4>& cell, std::span<const Vertex> vertices);

}  // namespace terratet
