// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Volumes of cells and areas of their walls.

#include "tess/voronoi/voronoi_complex.hpp"

namespace terratet {

struct VoronoiMeasures {
    std::vector<Vec3> area;      ///< of each wall: its normal, away from its cell, times its area
    std::vector<double> volume;  ///< of each cell
};

/// Walls need not be quite plane: both their cells take them for the same triangles, so that volumes add up.
/// \param points  in place of the complex' own: a linear image of them.
VoronoiMeasures measure(const VoronoiComplex& complex, std::span<const Vec3> points, std::size_t cells);

/// By cell: its walls, those with it on the other side too, in ascending order. Wall w of cell c is
/// walls[begin[c]…begin[c + 1]).
struct WallsOfCells {
    std::vector<std::uint32_t> begin;
    std::vector<std::uint32_t> walls;

    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t cell) const {
        return std::span(walls).subspan(begin[cell], begin[cell + 1] - begin[cell]);
    }
};
WallsOfCells walls_of_cells(const VoronoiComplex& complex, std::size_t cells);

}  // namespace terratet
