// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Vertices out of a tessellation and others into it, with their values.

#include <cstdint>
#include <vector>

#include "tess/mesh/delaunay.hpp"
#include "tess/tet_mesh.hpp"

namespace terratet {

/// Vertices with their values, ascending by id.
struct ValuedVertices {
    std::vector<Vertex> vertices;
    VertexValues values;  ///< in step with the vertices
};

/// Row i of the values, appended to others.
void append_row(const VertexValues& from, std::size_t i, VertexValues& to);

/// Takes out the vertices with the given ids and puts in others; both ascend. Returns what was taken out. The work on
/// cells is local; renumbering is O(n), a few nanoseconds a vertex. `touched`, if given, gets the vertices whose cells
/// have changed, by index. \pre values are in step with the tessellation.
ValuedVertices exchange(delaunay::Core& core, VertexValues& values, const std::vector<std::uint64_t>& out,
                        const ValuedVertices& in, std::vector<std::uint32_t>* touched = nullptr);

}  // namespace terratet
