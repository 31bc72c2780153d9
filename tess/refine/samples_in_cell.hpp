// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The samples that are no vertices, by the cell they lie in: what a cell's linear field has to meet.

#include <array>
#include <cstdint>
#include <vector>

#include "tess/mesh/quality.hpp"

namespace terratet {

/// Barycentric coordinates of a place; not finite for a cell without volume.
std::array<double, 4> weights_at(const CellPoints& cell, const Vec3& place);

class SamplesInCell {
  public:
    explicit SamplesInCell(std::vector<Vec3> places);

    struct Inside {
        std::uint32_t sample;
        std::array<double, 4> weights;
    };
    /// Those in the closed cell. About logarithmic in all, linear in those found.
    void find(const CellPoints& cell, std::vector<Inside>& found) const;

  private:
    struct Node {
        Box3 box;
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint32_t right = 0;  ///< the second child; the first follows at once; 0: a leaf
    };
    struct Planes;
    void split(std::uint32_t begin, std::uint32_t end);
    void descend(std::uint32_t node, const CellPoints& cell, const Planes& planes, std::vector<Inside>& found) const;

    std::vector<Vec3> places_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace terratet
