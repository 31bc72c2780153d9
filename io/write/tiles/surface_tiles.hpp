// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The scene's surfaces and boreholes in an octree of tiles, each of which shows all that its children show with fewer
/// triangles. Their borders are the same at every level: no gaps between tiles, whichever levels are drawn.

#include <cstdint>
#include <vector>

#include "io/write/scene/scene.hpp"
#include "io/write/tiles/surface_deviation.hpp"

namespace terratet {

/// Of one of the scene's parts, what a tile shows.
struct TilePart {
    std::uint32_t part = 0;
    std::vector<Triangle> triangles;   ///< of the part's positions
    std::vector<std::uint32_t> rings;  ///< of a borehole, instead: those of its tube that are kept, ascending
};

struct SurfaceTile {
    std::vector<TilePart> parts;  ///< ascending by part
    Deviation deviation;          ///< from the full surfaces, measured; never less than a child's
    Box3 box;                     ///< of all that is drawn here or below, in the scene's axes
    std::vector<SurfaceTile> children;
};

struct SurfaceTileOptions {
    std::size_t most_triangles = 8192;  ///< of a tile at full detail, unless one borehole has more
    std::size_t coarsest = 1024;        ///< levels are added above until the root has no more, where that goes
    double color_metres = 1;            ///< see SurfaceLook
};

/// Of all parts with triangles. Report: stage "write tiles".
SurfaceTile surface_tiles(const std::vector<ScenePart>& parts, const SurfaceTileOptions& options,
                          const Progress& progress);

/// The part with nothing but what a tile shows of it.
ScenePart shown(const ScenePart& part, const TilePart& of_tile);

}  // namespace terratet
