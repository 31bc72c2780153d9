// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tess/voronoi/voronoi_measures.hpp"

#include <numeric>

namespace terratet {

VoronoiMeasures measure(const VoronoiComplex& complex, std::span<const Vec3> points, std::size_t cells) {
    VoronoiMeasures measures;
    measures.area.reserve(complex.walls.size());
    measures.volume.assign(cells, 0);
    const WallsOfCells walls = walls_of_cells(complex, cells);
    for (const VoronoiWall& wall : complex.walls) {
        const auto polygon = complex.polygon(wall);
        Vec3 twice;
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            const Vec3& apex = points[polygon[0]];
            twice = twice + cross(points[polygon[i - 1]] - apex, points[polygon[i]] - apex);
        }
        measures.area.push_back(0.5 * twice);
    }
    // A cone from one of the cell's corners over each wall: near it, so that little cancels.
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const auto of_cell = walls.of(cell);
        if (of_cell.empty()) {
            continue;
        }
        const Vec3 from = points[complex.polygon(complex.walls[of_cell[0]])[0]];
        double volume = 0;
        for (const std::uint32_t w : of_cell) {
            const VoronoiWall& wall = complex.walls[w];
            const auto polygon = complex.polygon(wall);
            double cones = 0;
            for (std::size_t i = 2; i < polygon.size(); ++i) {
                const Vec3 apex = points[polygon[0]] - from;
                cones += dot(apex, cross(points[polygon[i - 1]] - from, points[polygon[i]] - from));
            }
            volume += wall.cell == cell ? cones : -cones;
        }
        measures.volume[cell] = volume / 6;
    }
    return measures;
}

WallsOfCells walls_of_cells(const VoronoiComplex& complex, std::size_t cells) {
    WallsOfCells result;
    result.begin.assign(cells + 1, 0);
    for (const VoronoiWall& wall : complex.walls) {
        ++result.begin[wall.cell + 1];
        if (wall.beyond >= 0) {
            ++result.begin[static_cast<std::size_t>(wall.beyond) + 1];
        }
    }
    std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
    std::vector<std::uint32_t> next(result.begin.begin(), result.begin.end() - 1);
    result.walls.resize(result.begin.back());
    for (std::uint32_t w = 0; w < complex.walls.size(); ++w) {
        const VoronoiWall& wall = complex.walls[w];
        result.walls[next[wall.cell]++] = w;
        if (wall.beyond >= 0) {
            result.walls[next[static_cast<std::size_t>(wall.beyond)]++] = w;
        }
    }
    return result;
}

}  // namespace terratet
