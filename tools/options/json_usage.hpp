// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The whole command line as JSON, from the declarations that the parser reads: for programs that call terratet.

#include <string>

namespace terratet::tools {

/// {"terratet": version, "commands": [{"name", "summary", "usage", "description", "examples", "arguments": {"name",
/// "min", "max"}, "groups": [{"title", "options": [{"names", "value", "type", "repeatable", "numbers", "help"}]}]}]}.
/// Names have their dashes; `type` is switch, text, number or count; `value` is what the help calls it.
std::string json_usage();

}  // namespace terratet::tools
