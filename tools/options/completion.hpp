// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Completion for shells: static text made from the table of commands, so that pressing Tab starts no program.

#include <string>
#include <vector>

namespace terratet::tools {

/// "bash", "fish", "zsh".
const std::vector<std::string>& shells();

/// The script that the shell is to read. Commands, topics of help and options are completed with their one-line help
/// where the shell shows it, all else as file names. Throws UsageError for another shell.
std::string completion_script(const std::string& shell);

}  // namespace terratet::tools
