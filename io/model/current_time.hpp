// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The time that goes into a model file.

#include <string>

namespace terratet {

/// SOURCE_DATE_EPOCH (seconds since 1970) when set, so that equal runs give equal files; in UTC.
std::string current_time_text(const char* format = "%Y-%m-%dT%H:%M:%SZ");

}  // namespace terratet
