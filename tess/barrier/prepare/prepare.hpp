// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The one door to barriers: from surfaces as they were read to cleaned sheets that meet in common edges, with their
/// margins and seeds (barrier.hpp says what they are, and what is guaranteed).

#include <span>
#include <vector>

#include "tess/barrier.hpp"
#include "tess/frame.hpp"
#include "tess/progress.hpp"

namespace terratet {

/// The widest any fault could need around the extent: r_p + 2s for the requested spacing and width, DESIGN §4.2. The
/// hull box is the extent grown by it.
double hull_margin(const BarrierOptions& options, double l_min);

/// Cleans, extends, cuts, remeshes and seeds. Never throws for bad geometry: a surface that cannot be used is refused
/// with its reason. Result independent of the order of `surfaces`; positions snapped to the frame. Throws Error when
/// max_seeds would be exceeded, UsageError for lengths that contradict each other (width above spacing, negative, not
/// finite; refine in exact mode). `samples` are what refine makes room for. Roughly 0.5 ms a triangle.
/// \pre All coordinates are acceptable (geometry.hpp) and local to `frame`; extent is not empty; l_min > 0.
BarrierPreparation prepare_barriers(const std::vector<Surface>& surfaces, const Box3& extent, const Frame& frame,
                                    double l_min, const BarrierOptions& options = {}, const Progress& progress = {},
                                    std::span<const Vec3> samples = {});

/// The spacing asked for, or as much less as it takes that no surface is refused for running too near to one that it
/// nowhere meets, if that can be afforded: with `affordable` seeds. Else what takes the nearest surfaces that can be.
double separating_spacing(const std::vector<Surface>& surfaces, const Box3& extent, const Frame& frame, double l_min,
                          const BarrierOptions& options, const Progress& progress);

}  // namespace terratet
