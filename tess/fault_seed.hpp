// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Internal: base points that cover a fault and its margin, and the test, by samples, that the seeds over them separate
/// its two sides.

#include <vector>

#include "tess/fault_mesh.hpp"

namespace terratet {

struct BasePoint {
    Vec3 position;
    Vec3 normal;  ///< unit
};

/// Chooses base points: the candidates in their order, but none nearer than s/2 to one chosen before; then points of
/// the mesh wherever a piece of it is not covered within s/√2. A point covers only what faces within 60° of its own
/// normal, so that near sheets of a fold are covered each. Gives up, with more than `most` points, when it would need
/// more. O(n).
std::vector<BasePoint> base_points(const std::vector<BasePoint>& candidates, const FaultMesh& mesh, double spacing,
                                   std::size_t most);

/// How far points of the mesh are from the nearest base point at most: an upper bound, within 2 % of the truth.
/// \pre Every point is within `at_most` of one, as base_points sees to.
double covering_radius(const FaultMesh& mesh, const std::vector<BasePoint>& base, double at_most);

struct Separation {
    bool holds = true;
    bool bent = false;  ///< a base point's tangent plane leaves the sheet before the next one
    Vec3 where;         ///< a sample that ends up on the wrong side
};

/// Is x ± δn nearest to a seed of its own side, at samples x all over the sheet and δ = `nearest` and width/2?
Separation test_separation(const FaultMesh& sheet, const std::vector<BasePoint>& base, double covering, double width,
                           double nearest);

}  // namespace terratet
