// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What was refused or remarked on while reading, as reports have it: fields as the options that set them.

#include <nlohmann/json_fwd.hpp>

#include "tess/diagnostics.hpp"

namespace terratet::tools {

/// [{"file", "line", "reason"}].
nlohmann::ordered_json rejected_json(const Diagnostics& diagnostics);

/// Of each file and reason: how many, and the first.
nlohmann::ordered_json rejected_by_reason_json(const Diagnostics& diagnostics);

/// ["…"].
nlohmann::ordered_json notes_json(const Diagnostics& diagnostics);

}  // namespace terratet::tools
