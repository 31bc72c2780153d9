// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Help for a terminal of 80 columns, from the declarations that the parser reads.

#include <string>
#include <vector>

#include "tools/options/command.hpp"

namespace terratet::tools {

/// What terratet is, its commands and topics.
std::string general_help();

/// A few lines for who types the bare name: the commands, and where to go on.
std::string short_usage();

/// What there is help on: topics, then commands.
std::vector<std::string> help_subjects();

std::string command_help(const CommandEntry& command);

/// Help on a command or a topic. Throws UsageError that lists what there is, the nearest first.
std::string help_on(const std::string& subject);

}  // namespace terratet::tools
