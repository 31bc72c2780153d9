// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// No file makes its reader call anybody. Only what is named as an input itself may be on a network: `/vsicurl/` and
/// the like, and `PG:` connection strings.

#include <string>

namespace terratet {

/// Does a path, or a whole word of a command line, name something on a network?
bool names_network(const std::string& text);

}  // namespace terratet
