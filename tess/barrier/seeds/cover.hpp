// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Base points that cover a fault and its margin.

#include <functional>
#include <vector>

#include "tess/base/tri_mesh.hpp"

namespace terratet {

struct BasePoint {
    Vec3 position;
    Vec3 normal;  ///< unit
};

/// Adds base points wherever a piece of the mesh is not within `radius` of one, if `allowed` there. A point covers only
/// what faces within 60° of its own normal, so that near sheets of a fold are covered each. Gives up, with more than
/// `most` points, when it would need more. O(n).
void cover(const TriMesh& mesh, double radius, std::size_t most, const std::function<bool(const Vec3&)>& allowed,
           std::vector<BasePoint>& base);

/// How far points of the mesh are from the nearest base point at most: an upper bound, within 2 % of the truth; no more
/// than `at_most`, which is what cover() saw to.
double covering_radius(const TriMesh& mesh, const std::vector<BasePoint>& base, double at_most);

}  // namespace terratet
