// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The cells that scenes are cut from: the tessellation as far as the extent goes, with its values.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/write/clip.hpp"
#include "io/write/clipped_mesh.hpp"
#include "tess/cut_cells.hpp"

namespace terratet {

struct SceneCells {
    const Model* model;
    ClippedMesh mesh;
    std::vector<std::vector<double>> values;  ///< [property][point], measured
    std::vector<double> extrapolation;        ///< of the points, 0…1
    std::vector<std::uint8_t> in_gap;         ///< of the cells; those are not drawn and count for no volume
    std::vector<std::string> region_names;

    [[nodiscard]] std::vector<double> scaled(std::size_t property) const;
    [[nodiscard]] double volume(std::size_t cell) const;  ///< in the cube of the model's unit
};

/// The cells that a clipped VTU has, or the tessellation's own as the extent's planes cut them: for values and volumes
/// that are the tessellation's to the last digit.
SceneCells scene_cells(const ModelView& view, const Progress& progress = {}, ClippedCells cells = ClippedCells::mended);

/// A place in a cell, by barycentric weights of up to four of the mesh's points.
struct CellPlace {
    std::array<std::uint32_t, 4> point{};
    std::array<double, 4> weight{};  ///< 0 where there is no point

    [[nodiscard]] double level(std::span<const double> of_points) const;
    /// The point with the largest weight; of equal ones the smallest.
    [[nodiscard]] std::uint32_t nearest() const;
};

/// What was cut out of cells, on its way to a part.
struct CutTriangles {
    std::vector<CellPlace> places;
    std::vector<Triangle> triangles;  ///< of places
    std::vector<std::uint32_t> cell;  ///< of each triangle

    [[nodiscard]] std::vector<Vec3> positions(const SceneCells& cells) const;  ///< frame-local
    /// Linear in the property's scale; of a category the value of the nearest point.
    [[nodiscard]] std::vector<double> values(const SceneCells& cells, std::size_t property) const;
    [[nodiscard]] std::vector<double> extrapolation(const SceneCells& cells) const;
    void drop_unused_places();
};

CutTriangles cut_triangles(const CellCut& cut);

/// The part of them where a level, given at the mesh's points, is at or above `at`, cut exactly there.
CutTriangles part_above(const CutTriangles& all, std::span<const double> level, double at);

/// Each triangle in pieces by which of its cell's points has the largest weight: what a category is there. `owner` gets
/// that point for each place.
CutTriangles by_nearest_point(const SceneCells& cells, const CutTriangles& all, std::vector<std::uint32_t>& owner);

}  // namespace terratet
