// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The cells that may have to be treated again after a change.

#include <vector>

#include "tess/mesh/delaunay.hpp"
#include "tess/refine/touched.hpp"

namespace terratet {

/// The finite cells at the touched vertices, at those from index `first_new` on, and those whose circumsphere meets a
/// touched box: each once, in no order. A walk over the vertices, else local.
std::vector<delaunay::Cell> touched_cells(const delaunay::Core& core, const Touched& touched, std::uint32_t first_new);

}  // namespace terratet
