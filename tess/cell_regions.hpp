// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Which part of the ground each cell belongs to.

#include <cstdint>
#include <vector>

namespace terratet {

/// Columns in step with TetMesh::cells.
struct CellRegions {
    std::vector<std::int32_t> region;     ///< fault block, 0…; −1 for gap cells and cells outside the extent
    std::vector<std::int32_t> barrier;    ///< barrier whose gap the cell fills; −1 otherwise
    std::vector<std::uint8_t> in_extent;  ///< 1 when the centroid lies in the extent, and not beyond
    std::vector<std::uint8_t> beyond;  ///< 1 above the topography, outside the outline of the domain, and in the gaps
                                       ///< of both: no output has such cells
    std::int32_t region_count = 0;     ///< regions are numbered by their smallest cell
};

}  // namespace terratet
