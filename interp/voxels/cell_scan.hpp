// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A tessellation's fields in the bricks of a lattice, by per-cell scan conversion: each cell's row spans are found
/// once and filled with its linear function of every field, so the cost follows cells and voxels and no point is ever
/// located (DESIGN §4.6).

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "interp/lattice.hpp"
#include "interp/voxels/bricks.hpp"
#include "tess/barrier/query/own_side.hpp"
#include "tess/model.hpp"

namespace terratet {

/// One field: a value at each vertex, linear in between.
struct ScanField {
    std::span<const double> vertex_values{};  ///< in the property's scale; NaN: no value in its cells
    const OwnSide* sides =
        nullptr;  ///< when given, cells that reach across a barrier take the voxel's own side's values, if it has any
    bool log10 = false;                           ///< write 10^value
    bool categorical = false;                     ///< write the class of the largest barycentric weight
    std::span<const std::int32_t> cell_values{};  ///< where not negative, a cell's own value instead
};

/// Byte-identical at any thread count: a voxel on a common facet, edge or vertex belongs to the cell with the smallest
/// index.
class CellScan final : public BrickSource {
  public:
    /// \param use_cell  one per cell; empty: all
    /// \param within    voxels whose centres lie outside have no value
    /// \pre mesh and fields outlive this.
    CellScan(const TetMesh& mesh, std::span<const std::uint8_t> use_cell, std::vector<ScanField> fields,
             const Lattice& lattice, const std::optional<Box3>& within = {});
    ~CellScan() override;

    [[nodiscard]] const Lattice& lattice() const override;
    [[nodiscard]] std::size_t fields() const override;
    void fill(Brick& brick) const override;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
