// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The table of commands. One file each: its arguments, its syntax, its thirty lines.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/options/option.hpp"

namespace terratet {
class Ranks;
}

namespace terratet::tools {

/// A command ready to parse and run: the syntax points into its own arguments.
class Command {
  public:
    virtual ~Command() = default;
    [[nodiscard]] virtual Syntax syntax() = 0;
    /// Opens what it has to listen at, after the targets are filled: afterwards no socket can be had
    /// (tools/run/offline.hpp).
    virtual void open_sockets() {}
    /// Of several processes that run the command each: does it share its work among them? Else rank 0 runs it alone.
    virtual bool share_among(const Ranks&) { return false; }
    /// Does the work after the targets are filled and returns the exit code. `given` goes to the model's journal.
    virtual int run(const std::vector<struct Given>& given) = 0;
};

struct CommandEntry {
    std::string name;
    std::string summary;                ///< one line, in the list of commands
    std::string usage;                  ///< after "terratet NAME"
    std::string description;            ///< a paragraph
    std::vector<std::string> examples;  ///< whole command lines
    std::function<std::unique_ptr<Command>()> make;
};

/// In the order of the help.
const std::vector<CommandEntry>& commands();

/// Throws UsageError with the nearest name.
const CommandEntry& find_command(const std::string& name);

CommandEntry build_command();
CommandEntry convert_command();
CommandEntry export_command();
CommandEntry info_command();
CommandEntry check_command();
CommandEntry edit_command();
CommandEntry query_command();
CommandEntry live_command();
CommandEntry validate_command();
CommandEntry resample_command();
CommandEntry completion_command();

}  // namespace terratet::tools
