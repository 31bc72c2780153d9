// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The samples that are no vertices, by the cell they lie in: what a cell's linear field has to meet.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "tess/base/box_tree.hpp"
#include "tess/mesh/quality.hpp"

namespace terratet {

/// Barycentric coordinates of a place; not finite for a cell without volume.
std::array<double, 4> weights_at(const CellPoints& cell, const Vec3& place);

class SamplesInCell {
  public:
    explicit SamplesInCell(std::span<const Vec3> places);

    struct Inside {
        std::uint32_t sample;
        std::array<double, 4> weights;
    };
    /// Those in the closed cell. About logarithmic in all, linear in those found.
    void find(const CellPoints& cell, std::vector<Inside>& found) const;

  private:
    struct Place {
        Vec3 position;
        std::uint32_t sample = 0;
    };
    BoxTree<Place> tree_;
};

}  // namespace terratet
