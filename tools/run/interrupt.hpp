// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Ctrl-C asks the running operation to stop at its next report of progress, so that it can clean up. Where none comes
/// within 0.15 s, the program ends all the same, with the same message and exit code, and nothing of unfinished outputs
/// remains. A second one ends the program at once.

namespace terratet::tools {

/// For SIGINT and SIGTERM.
void watch_for_interrupts();

bool interrupted();

/// A file that would grow beyond `ulimit -f` is a write that fails, instead of a signal that kills (SIGXFSZ).
void take_size_limits_as_errors();

/// True for the first who asks: the one to say that the program was interrupted.
bool tell_interrupted();

}  // namespace terratet::tools
