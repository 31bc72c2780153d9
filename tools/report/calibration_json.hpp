// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// How stated errors were calibrated, for reports.

#include <nlohmann/json_fwd.hpp>

#include "interp/calibration.hpp"

namespace terratet::tools {

/// Null where nothing is known.
nlohmann::ordered_json calibration_json(const Calibration& calibration);

}  // namespace terratet::tools
