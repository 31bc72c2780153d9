// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Point location in a flat mesh and linear interpolation in its cells.

#include <array>
#include <cstdint>
#include <optional>

#include "tess/tessellation.hpp"

namespace terratet {

/// Where a point is, and with which weights its cell's vertices make it.
struct CellPosition {
    std::uint32_t cell = 0;
    std::array<double, 4> weights{};  ///< barycentric: at least −1e-9 each, their sum is 1
};

/// Visibility walk with plain doubles from the last cell found: quick when consecutive points are near. Where rounding
/// makes it circle, all cells are searched. Nothing for a point outside the mesh.
class MeshWalk {
  public:
    explicit MeshWalk(const TetMesh& mesh) : mesh_(mesh) {}

    std::optional<CellPosition> locate(const Vec3& p);

  private:
    const TetMesh& mesh_;
    std::uint32_t last_ = 0;
};

}  // namespace terratet
