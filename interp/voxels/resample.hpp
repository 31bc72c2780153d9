// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One field of a tessellation to voxels (cell_scan.hpp).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "interp/voxels/cell_scan.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// A cubic brick of voxels, z fastest. Bricks at the lattice's end reach beyond it; those voxels are NaN.
struct Tile {
    static constexpr int edge = Brick::edge;
    std::array<std::int64_t, 3> lo{};  ///< index of its first voxel, multiples of edge
    std::span<const float> values;     ///< edge³; NaN: no value. Index ((i·edge)+j)·edge+k
};

/// Receives every tile that has a value exactly once, in any order, from many threads at a time.
class TileSink {
  public:
    virtual ~TileSink() = default;
    virtual void tile(const Tile& tile) = 0;
};

/// The linear fields to sample: cells with a value at each of their vertices.
struct LinearField {
    const TetMesh* mesh = nullptr;
    std::span<const double> vertex_values{};   ///< in the property's scale; NaN: no value in its cells
    std::span<const std::uint8_t> use_cell{};  ///< one per cell; empty: all
    const OwnSide* sides =
        nullptr;  ///< when given, cells that reach across a barrier take the voxel's own side's values, if it has any
    bool log10 = false;        ///< write 10^value
    bool categorical = false;  ///< write the class of the largest barycentric weight
};

/// Byte-identical at any thread count: a voxel on a common facet, edge or vertex belongs to the cell with the smallest
/// index. Threads as TBB allows.
void resample(const LinearField& field, const Lattice& lattice, TileSink& sink, const Progress& progress = {});

/// Into one dense array, x slowest and z fastest. For tests and small lattices.
std::vector<float> resample_dense(const LinearField& field, const Lattice& lattice);

}  // namespace terratet
