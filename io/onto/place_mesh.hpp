// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Somebody else's mesh, whose nodes and cells are to have a model's values: of a flow or a wave code, as it is.

#include <cstdint>
#include <vector>

#include "io/base/crs.hpp"
#include "tess/geometry.hpp"

namespace terratet {

/// Cells of any of VTK's types, their nodes one after the other.
struct PlaceMesh {
    std::vector<Vec3> points;  ///< true coordinates, in `crs`
    std::vector<std::int64_t> nodes;
    std::vector<std::int64_t> ends;   ///< of each cell, in `nodes`
    std::vector<std::uint8_t> types;  ///< VTK's: 10 tetrahedron, 12 hexahedron, 13 wedge, 14 pyramid, 42 polyhedron, …
    std::vector<std::int64_t> faces;  ///< of polyhedra, as VTK has them; empty: none
    std::vector<std::int64_t> face_ends;
    Crs crs;  ///< empty: not said

    /// The mean of each cell's nodes.
    [[nodiscard]] std::vector<Vec3> cell_centers() const;
};

}  // namespace terratet
