// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/command.hpp"
#include "tools/options/completion.hpp"
#include "tools/run/process.hpp"

namespace terratet::tools {
namespace {

class Completion final : public Command {
  public:
    Syntax syntax() override { return {"completion", {}, {"SHELL", 1, 1, &shell_}}; }

    int run(const std::vector<Given>&) override { return print(completion_script(shell_.front())); }

  private:
    std::vector<std::string> shell_;
};

}  // namespace

CommandEntry completion_command() {
    return {"completion",
            "a script that completes commands and options",
            "bash|zsh|fish",
            "Prints the script by which a shell completes terratet's commands and options at a press of Tab. Installed "
            "packages bring it along.",
            {"terratet completion bash > ~/.local/share/bash-completion/completions/terratet",
             "terratet completion fish > ~/.config/fish/completions/terratet.fish"},
            [] { return std::make_unique<Completion>(); }};
}

}  // namespace terratet::tools
