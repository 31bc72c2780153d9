// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which facets of a collapsed tessellation are the faults, and its nodes split along them.

#include <cstdint>
#include <span>
#include <vector>

#include "tess/collapse/collapse_image.hpp"
#include "tess/model.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// What is known of the image's cells before nodes are split: columns of the cell table to be.
struct CellStates {
    std::vector<std::int32_t> barrier;    ///< whose gap it fills, of those that keep theirs
    std::vector<std::uint8_t> beyond;     ///< the ground or the outline
    std::vector<std::uint8_t> in_extent;  ///< and not beyond
    std::vector<std::int32_t> region;     ///< as before
};

/// A node of the result: some of the image's cells round one of its nodes.
struct NodePart {
    std::uint32_t node = 0;
    std::vector<std::uint32_t> vertices;  ///< of the model, whose value it has: ascending
};

/// The image with its nodes split: cells over parts.
struct SplitImage {
    std::vector<NodePart>
        parts;  ///< in the order of their nodes, so that twins are ordered alike on both sides of a fault
    std::vector<std::int32_t> regions;                    ///< of the cells
    std::vector<std::array<std::uint32_t, 4>> cells;      ///< over parts
    std::vector<std::array<std::int32_t, 4>> neighbours;  ///< none across faults
    std::size_t split_places = 0;                         ///< nodes with more than one part
    double split_area = 0;                                ///< of facets on faults, in the extent
    std::vector<Vec3> off_barriers_of;                    ///< nodes of split facets in the extent that are on no fault
};

/// Facets on the surfaces of the selected faults, between cells of their two sides, part the cells round each node.
/// `nodes` are the image's.
SplitImage split_nodes(const Model& model, const std::vector<char>& selected, const CollapseImage& image,
                       std::span<const FaultNode> nodes, const CellStates& states, const Poll& poll = {});

}  // namespace terratet
