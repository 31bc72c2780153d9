// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Is a file a well log, of which format? Tables, logs and `info` all ask before they open anything.

#include <string>

namespace terratet {

enum class WellFormat { none, las, ags, gef, gocad, rms };

/// By the first lines, in any encoding; none for what cannot be opened, and for tables. Throws InputError for what is
/// known, and known to be no log of ours: a LiDAR cloud that is called LAS too, DLIS, BRO-XML, Petrel's tops, ….
WellFormat well_format(const std::string& path);

}  // namespace terratet
