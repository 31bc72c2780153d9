// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How near other vertices may come to a fault, place by place. Where its triangles are smaller than the
/// spacing, r_p = √(ρ² + ε²/4) is smaller as well, with the ρ and ε of the place.

#include <span>
#include <vector>

#include "tess/barrier.hpp"

namespace terratet {

/// The protection radius of each triangle of a fault, its sheet's and then its margin's: the fault's own, or less where
/// the triangle's corners are base points that are nearer together. It is the fault's own where the seeds of another
/// fault are near: that these do not let edges slip through was seen to with that radius.
std::vector<double> protection_radii(std::span<const Barrier> barriers, std::size_t barrier);

}  // namespace terratet
