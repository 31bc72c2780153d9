// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/options/completion.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "tools/options/command.hpp"
#include "tools/options/help.hpp"
#include "tools/options/values.hpp"

namespace terratet::tools {
namespace {

/// In single quotes, for any of the three shells.
std::string quoted(const std::string& text, const std::string& quote) {
    std::string out = "'";
    for (const char c : text) {
        out += c == '\'' ? quote : std::string(1, c);
    }
    return out + "'";
}
std::string posix_quoted(const std::string& text) {
    return quoted(text, R"('\'')");
}

template <class Visitor>
void for_each_option(const CommandEntry& entry, Visitor visit) {
    const auto command = entry.make();
    for (const auto& group : command->syntax().groups) {
        for (const auto& option : group.options) {
            visit(option);
        }
    }
}

std::string option_names(const CommandEntry& entry) {
    std::string out = "--help";
    for_each_option(entry, [&](const Option& option) {
        for (const auto& name : option.names) {
            out += " " + dashed(name);
        }
    });
    return out;
}

std::string command_names() {
    std::string out;
    for (const auto& entry : commands()) {
        out += entry.name + " ";
    }
    return out + "help";
}

std::string topic_names() {
    std::string out;
    for (const auto& subject : help_subjects()) {
        out += (out.empty() ? "" : " ") + subject;
    }
    return out;
}

/// For the shell's `case $previous`: the words that an option takes.
std::string bash_words(const CommandEntry& entry) {
    std::string cases;
    for_each_option(entry, [&](const Option& option) {
        if (words_of(option).empty()) {
            return;
        }
        for (const auto& name : option.names) {
            cases += fmt::format("    {}) words={} ;;\n", posix_quoted(entry.name + " " + dashed(name)),
                                 posix_quoted(fmt::format("{}", fmt::join(words_of(option), " "))));
        }
    });
    return cases;
}

std::string bash_script() {
    std::string cases;
    std::string words;
    for (const auto& entry : commands()) {
        cases += fmt::format("    {}) options={} ;;\n", entry.name, posix_quoted(option_names(entry)));
        words += bash_words(entry);
    }
    return fmt::format(
        R"(# bash completion for terratet: source it, or put it into ~/.local/share/bash-completion/completions/terratet
_terratet() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} options='' words=''
  if [ "$COMP_CWORD" -eq 1 ]; then
    COMPREPLY=($(compgen -W '{} --version --help --json-usage' -- "$word"))
    return
  fi
  case ${{COMP_WORDS[1]}} in
    help) COMPREPLY=($(compgen -W '{}' -- "$word")); return ;;
{}  esac
  case "${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD-1]}}" in
{}  esac
  if [ -n "$words" ]; then
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    return
  fi
  case $word in
    -*) COMPREPLY=($(compgen -W "$options" -- "$word")) ;;
    *) COMPREPLY=($(compgen -f -- "$word")) ;;
  esac
}}
complete -o filenames -F _terratet terratet
)",
        command_names(), topic_names(), cases, words);
}

/// What stands in a description of _arguments: colons and brackets have a meaning there.
std::string zsh_text(const std::string& text) {
    std::string out;
    for (const char c : text) {
        out += (c == ':' || c == '[' || c == ']' || c == '\\') ? std::string("\\") + c : std::string(1, c);
    }
    return out;
}

std::string zsh_script() {
    std::string described, cases;
    for (const auto& entry : commands()) {
        described += fmt::format("    {}\n", posix_quoted(entry.name + ":" + zsh_text(entry.summary)));
        cases += fmt::format("    {})\n      _arguments '--help[options and examples]'", entry.name);
        for_each_option(entry, [&](const Option& option) {
            const auto& words = words_of(option);
            const std::string values = words.empty() ? "_files" : fmt::format("({})", fmt::join(words, " "));
            for (const auto& name : option.names) {
                std::string spec = fmt::format("{}{}[{}]", is_repeatable(option) ? "*" : "", dashed(name),
                                               zsh_text(help_text(option)));
                spec += option.value.empty() ? "" : fmt::format(":{}:{}", zsh_text(option.value), values);
                cases += " \\\n        " + posix_quoted(spec);
            }
        });
        cases += " \\\n        '*:file:_files' ;;\n";
    }
    return fmt::format(R"(#compdef terratet
# zsh completion for terratet: put it into a folder of $fpath as _terratet
_terratet() {{
  local -a commands
  commands=(
{}    'help:on a command or a topic'
  )
  if (( CURRENT == 2 )); then
    _describe command commands
    return
  fi
  shift words
  (( CURRENT-- ))
  case $words[1] in
    help) compadd {} ;;
{}  esac
}}
compdef _terratet terratet
)",
                       described, topic_names(), cases);
}

std::string fish_script() {
    const auto text = [](const std::string& of) { return quoted(of, "\\'"); };
    std::string out =
        "# fish completion for terratet: put it into ~/.config/fish/completions/terratet.fish\n"
        "complete -c terratet -n __fish_use_subcommand -l version -d 'print the version'\n";
    for (const auto& entry : commands()) {
        out += fmt::format("complete -c terratet -f -n __fish_use_subcommand -a {} -d {}\n", entry.name,
                           text(entry.summary));
        for_each_option(entry, [&](const Option& option) {
            for (const auto& name : option.names) {
                const auto& words = words_of(option);
                out += fmt::format("complete -c terratet -n '__fish_seen_subcommand_from {}' -{} {}{}{} -d {}\n",
                                   entry.name, name.size() == 1 ? "s" : "l", name, option.value.empty() ? "" : " -r",
                                   words.empty() ? "" : fmt::format(" -f -a '{}'", fmt::join(words, " ")),
                                   text(help_text(option)));
            }
        });
    }
    out += "complete -c terratet -f -n __fish_use_subcommand -a help -d 'on a command or a topic'\n";
    return out + fmt::format("complete -c terratet -f -n '__fish_seen_subcommand_from help' -a '{}'\n", topic_names());
}

}  // namespace

const std::vector<std::string>& shells() {
    static const std::vector<std::string> names{"bash", "zsh", "fish"};
    return names;
}

std::string completion_script(const std::string& shell) {
    using Maker = std::string (*)();
    return named("completion", [&] {
        return choose<Maker>(shell, {{"bash", bash_script}, {"zsh", zsh_script}, {"fish", fish_script}});
    })();
}

}  // namespace terratet::tools
