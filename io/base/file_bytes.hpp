// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>

namespace terratet {

/// At most `count` bytes from `offset` on, through GDAL's virtual file systems: fewer where the file ends, none of a
/// folder or of what cannot be opened.
std::string file_bytes(const std::string& path, std::size_t offset, std::size_t count);

}  // namespace terratet
