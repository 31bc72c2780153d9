// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Whose log it is and where its hole stands, from a LAS header.

#include <string>

#include "io/read/logs/las_header.hpp"
#include "io/read/logs/well_file.hpp"

namespace terratet {

/// Adds the hole's names (UWI, API, well name, …; the file's own name for want of all), its collar where the header has
/// one, and the facts.
void place_las(const LasHeader& header, const std::string& path, const std::string& file, WellFile& result);

}  // namespace terratet
