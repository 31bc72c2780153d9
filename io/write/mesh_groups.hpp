// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What of a mesh simulators want to name: blocks, gaps, facets of barriers and of the extent's sides.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/write/clipped_mesh.hpp"

namespace terratet {

/// Elements with one name, numbered among those of their dimension.
struct MeshGroup {
    int dimension = 3;
    int tag = 0;
    std::string name;
    std::vector<std::array<std::uint32_t, 4>> elements;  ///< of a triangle the first three
    std::vector<std::uint32_t> cells;                    ///< of each: itself, or the cell that the facet is seen from
};

/// Of the extent: twice the axis, and one more where the coordinate is largest.
inline constexpr const char* side_names[] = {"west", "east", "south", "north", "bottom", "top"};

/// Surfaces before volumes: the extent's sides are west, east, south, north, bottom and top, other surfaces have the
/// names of the barriers; volumes those of the blocks, or "gap of" a barrier.
std::vector<MeshGroup> mesh_groups(const ModelView& view, const ClippedMesh& mesh);

}  // namespace terratet
