// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Help for a terminal of 80 columns, from the declarations that the parser reads.

#include <string>

#include "tools/command.hpp"

namespace terratet::tools {

/// What terratet is, its commands and topics.
std::string general_help();

std::string command_help(const CommandEntry& command);

/// Help on a command or a topic. Throws UsageError that lists what there is.
std::string help_on(const std::string& subject);

}  // namespace terratet::tools
