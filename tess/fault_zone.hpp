// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Internal: the protection zone of prepared faults, asked very often: the same places as
/// FaultProximity::protecting_fault, but what one question costs hardly grows where triangles are small and many.

#include <span>
#include <vector>

#include "tess/fault.hpp"
#include "tess/fault_mesh.hpp"

namespace terratet {

class FaultZone {
  public:
    explicit FaultZone(std::span<const Fault> faults);

    /// Nearer to a triangle of a sheet or margin than its protection radius?
    [[nodiscard]] bool contains(const Vec3& p) const;

  private:
    struct Ball {  ///< what is kept about a triangle
        TriangleCorners corners{};
        double radius = 0;
    };
    struct Node {
        Box3 box;
        double radius = 0;  ///< the largest below
        std::uint32_t begin = 0;
        std::uint32_t end = 0;
        std::uint32_t right = 0;  ///< the second child; the first follows at once; 0: a leaf
    };
    void split(std::uint32_t begin, std::uint32_t end);

    std::vector<Ball> balls_;
    std::vector<Node> nodes_;
};

}  // namespace terratet
