// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Grids into an OpenVDB file, whole or with an error. OpenVDB's own File::write does not look at its stream again, so
/// that a full disk cuts the file short without a word.

#include <openvdb/openvdb.h>

#include <string>

namespace terratet {

/// Writes `grids` to `path` (a temporary file) and reads the index back: every grid there, by its name, in a file of
/// the size that was written. Throws Error with the system's reason, naming `shown`.
void write_vdb_file(const std::string& path, const std::string& shown, const openvdb::GridPtrVec& grids,
                    const openvdb::MetaMap& meta);

}  // namespace terratet
