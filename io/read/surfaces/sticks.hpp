// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Faults as interpreters draw them on sections: sticks, one behind the other.

#include <string>
#include <vector>

#include "tess/surface.hpp"

namespace terratet {

/// Triangles between each stick and the next, by the shorter of the two diagonals. Sticks keep their order and are
/// turned to run alike. Consecutive repetitions of a point, and sticks of a single one, are left out. No triangles from
/// fewer than two sticks. O(n).
Surface surface_of_sticks(std::string name, std::vector<std::vector<Vec3>> sticks);

}  // namespace terratet
