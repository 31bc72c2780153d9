// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The domain: the extent, and the hull box that the tessellation fills. Its faces carry a grid of vertices, without
/// which circumcentres outside the hull make refinement diverge.

#include <cstdint>
#include <span>
#include <vector>

#include "tess/frame.hpp"
#include "tess/geometry.hpp"
#include "tess/outline.hpp"
#include "tess/progress.hpp"

namespace terratet {

struct Domain {
    Box3 extent;      ///< what the user asked about; exported clipped to it or flagged in_extent
    Box3 hull;        ///< the extent without faults; grown by hull_margin() with them
    Rings outline{};  ///< what bounds the model in plan; none: the extent alone

    friend bool operator==(const Domain&, const Domain&) = default;
};

/// Grid points on the faces of the hull box: spacing at most l_max/√2 and, as far as a face allows two rows, never
/// below l_min; the corners always, other points unless nearer than l_min to one of `obstacles`. Each once, sorted,
/// snapped.
std::vector<Vec3> face_grid(const Box3& hull, double l_min, double l_max, std::span<const Vec3> obstacles,
                            const Frame& frame, const Poll& poll = {});

}  // namespace terratet
