// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The free rims of barriers, and how near a line of sight passes by them.

#include <array>
#include <cstdint>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// An edge's two ends.
using EdgePlace = std::array<Vec3, 2>;

class FreeRims {
  public:
    FreeRims() = default;

    /// \param spacing  of their barrier, the unit of distances from them; rims are left out where it is 0
    void add(const std::vector<EdgePlace>& rims, double spacing);

    /// After the last one was added. O(n log n).
    void finish();

    /// The segment's distance from the nearest rim, each in units of its fault's spacing, but at most 1. O(log n) far
    /// from rims.
    [[nodiscard]] double clearance(const Vec3& a, const Vec3& b) const;

  private:
    struct Edge {
        Vec3 from, to;
        double spacing;
    };
    struct Node {
        Box3 box;  ///< of its edges, each grown by its spacing
        std::uint32_t begin, end;
        std::uint32_t right;  ///< the second child; the first follows at once; 0: a leaf
    };

    void split(std::uint32_t begin, std::uint32_t end);

    std::vector<Edge> edges_;
    std::vector<Node> nodes_;
};

/// Between two closed segments (Ericson, Real-Time Collision Detection, 5.1.9).
double segment_distance(const Vec3& p1, const Vec3& q1, const Vec3& p2, const Vec3& q2);

}  // namespace terratet
