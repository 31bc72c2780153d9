// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Man pages, from the declarations that the parser reads; the build writes and installs them.

#include <string>

#include "tools/options/command.hpp"

namespace terratet::tools {

/// terratet-NAME.1: name, synopsis, description, options by group, exit status, examples.
std::string man_page(const CommandEntry& entry);

/// terratet.1: the program and its commands.
std::string man_page();

}  // namespace terratet::tools
