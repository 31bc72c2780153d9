// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

/// Where a tessellation that met its criteria has been changed since.
struct Touched {
    std::vector<std::uint32_t> vertices;  ///< those whose cells are others than before, by index
    std::vector<Box3> boxes;              ///< the rules have changed for cells whose circumspheres meet one of these
};

}  // namespace terratet
