// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// OpenVDB puts a random UUID into each file's header, to tell two versions of a file apart;
/// equal inputs shall make equal bytes.

#include <string>

namespace terratet {

/// Replaces the UUID by one made from the file's other bytes (version 8 of RFC 9562: the maker's own), which still
/// tells different files apart. Throws Error when the file does not begin as OpenVDB's format 213 to 224 does,
/// or cannot be written; the message names `shown`.
void make_vdb_identity_reproducible(const std::string& path, const std::string& shown);

}  // namespace terratet
