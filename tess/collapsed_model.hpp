// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A model whose faults have no width (collapse.hpp).

#include <vector>

#include "tess/cells.hpp"
#include "tess/conformity.hpp"
#include "tess/model.hpp"

namespace terratet {

struct CollapseReport {
    std::size_t dropped_cells = 0;  ///< gap cells that are gone, or that others fill
    std::size_t split_places = 0;   ///< places with more than one node
    std::size_t added_places = 0;   ///< where an edge of one sheet crossed one of the other; in exact mode a fault
    double split_area = 0;          ///< of the facets on faults, in the extent, each pair once
    double sheet_area = 0;          ///< of the faults themselves: as much, but for bends, unless a fault has holes now
    std::vector<Vec3> apart;  ///< places on the faults where the sheets could not meet: thin cells stay on the − side
    std::vector<Vec3> aside;  ///< places where, besides, the facets stay off the surface by half the fault's width; in
                              ///< exact mode where an edge through a fault could not be cut, and nodes beside the
                              ///< faults at which regions meet
    Conformity conformity;    ///< with what lies above the ground and outside the outline
};

/// A model's mesh with its faults collapsed, in the shape that writers take.
struct CollapsedModel {
    Model model;   ///< the vertices are nodes here: in the order of their places, those of one place one after the
                   ///< other, their ids unique but not ascending. A node on one side carries its seed's id, owner, side
                   ///< and values, a fault's own vertex the mean of the seeds round it on that side; one on a rim has
                   ///< side 0 and the mean of all its seeds' values
    TetMesh mesh;  ///< split facets have no neighbour
    CellTable
        cells;  ///< fault is −1 where it was collapsed; regions are the same, and have the cells of the gaps as well
    CollapseReport report;
};

}  // namespace terratet
