// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The one order of all that a site holds, so that nothing depends on the order of rows.

#include <cstddef>

#include "tess/site.hpp"

namespace terratet {

/// Boreholes by id, samples in canonical order and without coincident ones, surfaces in theirs. Returns how many
/// samples were merged into others.
std::size_t canonicalise(Site& site);

}  // namespace terratet
