// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Several files by one name.

#include <vector>

#include "io/source.hpp"

namespace terratet {

/// A file, or the files of a folder or of a pattern (`wells/*.las`), by name. Throws InputError where a pattern or
/// folder has none.
std::vector<Source> files_of(const Source& source);

}  // namespace terratet
