// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where the edges of a tessellation run through faults.

#include <span>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/base/triangle_grid.hpp"

namespace terratet {

class SheetCrossings {
  public:
    struct Crossing {
        double at = 0;  ///< from a (0) to b (1)
        std::int32_t barrier = -1;
        friend auto operator<=>(const Crossing&, const Crossing&) = default;
    };

    /// For segments up to `longest`, which should be a few spacings at most.
    SheetCrossings(std::span<const Barrier> barriers, const Box3& extent, const std::vector<char>& selected,
                   double longest);

    /// The selected faults that part the ends, ascending: those whose sheets the segment meets once, or three times,
    /// ..., there the middle one; beyond the extent their margins too. What two triangles share is met once.
    [[nodiscard]] std::vector<Crossing> operator()(const Vec3& a, const Vec3& b) const;

  private:
    struct Owner {
        std::int32_t barrier = -1;
        bool margin = false;
    };
    Box3 extent_;
    TriangleGrid triangles_;
    std::vector<Owner> owner_;
};

}  // namespace terratet
