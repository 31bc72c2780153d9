// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Ctrl-C asks the running operation to stop at its next report of progress, so that it can clean up. A second one
/// ends the program at once.

namespace terratet::tools {

/// For SIGINT and SIGTERM.
void watch_for_interrupts();

bool interrupted();

}  // namespace terratet::tools
