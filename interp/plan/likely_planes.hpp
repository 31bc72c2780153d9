// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Planes along which values change least, as samples show them: candidates, to be judged by others.

#include <vector>

#include "interp/anisotropy.hpp"
#include "interp/plan/left_out_scores.hpp"

namespace terratet {

/// Layers that go on from hole to hole. For a plane's normal, what one borehole measured is compared with what its
/// neighbours measured at the same height along the normal; sought are the normals where the two are most alike, on a
/// half sphere in steps of 8 degrees, then nearer and nearer to the best, down to a quarter of one. At each step logs
/// are smoothed along the hole over half of what a step means at the next hole, or a thin layer would be missed between
/// two steps. Unit normals, up, the best first, at most `count`; none for fewer than two boreholes. Some 0.3 s.
std::vector<Vec3> planes_between_holes(const SampledValues& data, std::size_t count);

/// Squared differences of near samples over their squared distance, as a quadratic form of the direction between them
/// (least squares): its axes and how the roots of its values relate, from 1 to 0.02. Isotropic where it tells nothing.
Anisotropy anisotropy_of_slopes(const SampledValues& data);

/// With the first axis down the plane's dip, the third along its normal.
Anisotropy flattened(const Vec3& normal, double ratio3);

}  // namespace terratet
