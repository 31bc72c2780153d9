// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Compositing: logs of uneven intervals brought to one length, so that each sample stands for as much rock as any
/// other.

#include "tess/model.hpp"

namespace terratet {

struct CompositeReport {
    std::size_t intervals = 0;   ///< that went in
    std::size_t composites = 0;  ///< that came out
    std::size_t dropped = 0;     ///< values of composites covered to less than half, left out
};

/// Replaces the interval samples of each borehole by composites from k·length to (k + 1)·length of its depth, k = 0, 1,
/// … Each property's value is the mean of the intervals' weighted by the length they share with the composite, in its
/// scale; of a category the class with the largest share (ties: the smaller index). Gaps are not bridged: a property
/// needs values over half of the composite (of what the hole's end leaves of the last one), else it has none there; a
/// composite without any is left out. With a censored part the composite is censored. A composite stands at the middle
/// of its depths on the borehole's path. Point samples and loose ones stay as they are. Result in canonical order. O(n
/// log n). \pre length > 0
CompositeReport composite(Site& site, double length);

}  // namespace terratet
