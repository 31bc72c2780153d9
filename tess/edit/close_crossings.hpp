// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The last word on F1. Seeds are sealed before other vertices are known, by looking at many places of each empty ball
/// (leaks.hpp), not at all: what slips through nevertheless is found in the finished tessellation, and other vertices
/// keep out of the place from then on.

#include <span>

#include "tess/cells/crossing_edges.hpp"

namespace terratet {

/// Adds a flake (seal.hpp) to the crossed fault's margin for each edge: in the middle of the smallest empty ball with
/// the edge, where the fault's protection radius covers that, else at the edge's ends. So no sample or inserted vertex
/// can stand where one of the edge's ends stood. False when nothing was added: edges between seeds, or the box's
/// vertices, stay. Deterministic; O(cells) per call.
bool close_crossings(std::span<const CrossingEdge> edges, const TetMesh& mesh, Model& model);

}  // namespace terratet
