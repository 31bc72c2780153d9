// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tess/model.hpp"

namespace terratet {

/// Ends of a colour map, in the property's scale.
struct ColorRange {
    double low = 0;
    double high = 1;
};

/// The 2nd and 98th percentile of the vertices' values, so that an outlier does not leave one colour for all the rest.
/// Of vertices beyond the reach of the samples (extrapolation 1) only where there are no others.
ColorRange color_range(const Model& model, std::size_t property);

}  // namespace terratet
