// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A site: all that was measured, and how it is placed on the earth.

#include <vector>

#include "tess/borehole.hpp"
#include "tess/frame.hpp"
#include "tess/property.hpp"
#include "tess/samples.hpp"
#include "tess/surface.hpp"

namespace terratet {

/// What was measured, in one frame: the readers' result. Boreholes sorted by id, samples and surfaces in canonical
/// order.
struct Site {
    Frame frame;
    std::vector<Property> properties;
    std::vector<Borehole> boreholes;
    Samples samples;
    std::vector<Surface> surfaces;
};

}  // namespace terratet
