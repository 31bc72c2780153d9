// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Where a tileset's tiles lie: in a folder beside it that has its name.

#include <string>

namespace terratet {

/// \param path  of the tileset, NAME.json
std::string tiles_folder(const std::string& path);

/// True: the folder holds nothing but what a tileset's does, or is not there, and may be replaced. Throws Error that
/// names what else there is.
bool holds_only_tiles(const std::string& path);

}  // namespace terratet
