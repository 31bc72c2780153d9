// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What is in a file of the kinds that this program writes: named by its content, summed up by its header, so that a
/// gigabyte costs a moment.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tess/geometry.hpp"

namespace terratet {

struct SeenOutput {
    std::string format;  ///< "glTF 2.0 binary", "VTK unstructured grid", "OpenVDB", …
    std::string crs;     ///< name or code as the file has it; empty: none
    Box3 extent;         ///< in true coordinates; empty: not told
    std::vector<std::pair<std::string, std::string>> facts;               ///< {"vertices", "1234"}
    std::vector<std::pair<std::string, std::vector<std::string>>> lists;  ///< {"nodes", {…}}
};

/// Nothing for what is none of them (a table, a model, a log). Throws InputError: it is one, and damaged.
std::optional<SeenOutput> see_output(const std::string& path);

}  // namespace terratet
