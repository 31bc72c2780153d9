// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model's Voronoi cells as writers want them.

#include "io/export.hpp"
#include "tess/voronoi/voronoi_cells.hpp"
#include "tess/voronoi/voronoi_measures.hpp"

namespace terratet {

/// In the map's unit.
struct MappedVoronoi {
    VoronoiCells cells;
    std::vector<Vec3> points;  ///< true coordinates, in step with the complex'
    VoronoiMeasures measures;
};

/// \pre The view is of the model's own mesh.
MappedVoronoi mapped_voronoi(const ModelView& view, const Progress& progress);

/// Polyhedra, an array's entry a cell.
OutputRecord write_voronoi_vtu(const ModelView& view, const std::string& path, const ExportOptions& options);

}  // namespace terratet
