// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// When refinement finds that the criteria ask for too much.

#include <cstddef>
#include <cstdint>

#include "tess/error.hpp"

namespace terratet {

/// What refinement throws that gets beyond the limit, which nothing showed before.
/// \param others  vertices before refinement
/// \param bound   most that it can insert with this l_min (R1)
UsageError refinement_beyond(std::uint64_t max_vertices, std::size_t others, double l_min, double bound);

}  // namespace terratet
