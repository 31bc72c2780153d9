// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Are points those of a sheet that is a graph over its plane?

#include "tess/surface.hpp"

namespace terratet {

/// Of a surface that was triangulated in a plane: do at most one in twenty of its edges rise steeply (more than twice
/// their length in the plane, and than two middle lengths)? Points in a volume, or of a sheet that lies over itself,
/// give neighbours in the plane that are far apart in space. O(n).
bool is_graph(const Surface& surface);

}  // namespace terratet
