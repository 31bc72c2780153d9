// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// No file makes its reader call anybody. Only what is named as an input itself may be on a network: `/vsicurl/` and
/// the like, and `PG:` connection strings.

#include <string>

namespace terratet {

/// Does a path, or a whole word of a command line, name something on a network?
bool names_network(const std::string& text);

/// For a program that uses GDAL through Terratet alone: takes out all of its drivers but those that readers and writers
/// use, so that a file which has another opened (an overview beside a raster, say) finds none. Some call servers that
/// the file names, some hang on hostile files. Once, at the start.
void keep_needed_gdal_drivers();

}  // namespace terratet
