// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Samples chosen by a condition on their columns.

#include <string>
#include <vector>

#include "tess/site.hpp"

namespace terratet {

/// Marks the samples for which an SQL condition holds, in step with them. It may name borehole, depth, length, x, y, z
/// (true coordinates) and the properties by their columns (docs/model-file.md); what it says is SQLite's. Throws
/// UsageError for a condition that is none.
std::vector<bool> samples_where(const Site& site, const std::string& condition);

}  // namespace terratet
