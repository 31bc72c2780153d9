// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What the shell is told.

namespace terratet::tools {

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;  ///< while running
inline constexpr int exit_usage = 2;
inline constexpr int exit_input = 3;  ///< the input data cannot be used
inline constexpr int exit_unmet = 4;  ///< done, but criteria stay unmet and --strict is given

}  // namespace terratet::tools
