// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Closes the places where the seeds of prepared faults would let an edge through (F1).
///
/// A leak (leaks.hpp) whose ball is no larger than the protection radius is closed by keeping other vertices out
/// of the ball: a *flake*, a tiny triangle in its centre, joins the margin. A larger one is a hole in the cover: a
/// mirrored pair of seeds is added where the sheet runs through it. Where there is no room for one, a pair goes that
/// all but lies on the other sheet, or several flakes keep free what the ball reaches. All this is repeated until
/// nothing leaks, or no more can be done.

#include <functional>
#include <span>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/base/tri_mesh.hpp"
#include "tess/frame.hpp"

namespace terratet {

struct Seal {
    struct Open {
        std::uint32_t barrier = 0;  ///< the one crossed
        std::uint32_t owner = 0;    ///< of the seed that the edge would start from
        Vec3 place;
    };
    std::vector<std::vector<Seed>> seeds;  ///< by fault: mirrored pairs, + first; the given ones but for dropped ones,
                                           ///< in their order, and then added ones
    std::vector<TriMesh> flakes;           ///< to join the margins, by fault
    std::vector<Vec3> changed;             ///< where seeds came or went
    std::vector<Open> open;                ///< what could not be closed, ascending
};

/// Deterministic for faults in a given order. Some 50 µs a seed. Tells the progress the share that is done, and passes
/// on what that throws.
Seal seal_sheets(std::span<const Barrier> barriers, const Box3& hull, const Frame& frame,
                 const std::function<void(double)>& progress = {});

}  // namespace terratet
