// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One call of the program: from arguments to an exit code.

#include <string>
#include <vector>

namespace terratet::tools {

/// Runs the command that the arguments (without the program's name) ask for. Every error becomes one line on standard
/// error that begins with "terratet: ", and an exit code (exit_code.hpp); nothing is thrown.
int run_terratet(const std::vector<std::string>& arguments);

}  // namespace terratet::tools
