// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/commands/session.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "interp/ranks/ranks.hpp"
#include "tess/error.hpp"
#include "tools/options/command.hpp"
#include "tools/options/command_line.hpp"
#include "tools/options/field_names.hpp"
#include "tools/options/help.hpp"
#include "tools/options/json_usage.hpp"
#include "tools/options/man_page.hpp"
#include "tools/options/printable.hpp"
#include "tools/options/text.hpp"
#include "tools/run/interrupt.hpp"
#include "tools/run/offline.hpp"
#include "tools/run/process.hpp"
#include "tools/version.hpp"

namespace terratet::tools {
namespace {

/// Nothing that a file holds reaches the terminal as it is.
class PrintableFormatter final : public spdlog::formatter {
  public:
    void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& out) override {
        const std::string text = printable(with_options({message.payload.data(), message.payload.size()}), true) + "\n";
        out.append(text.data(), text.data() + text.size());
    }
    [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override {
        return std::make_unique<PrintableFormatter>();
    }
};

/// Summaries and warnings go to standard error; standard output carries data only.
void start_log() {
    auto logger = std::make_shared<spdlog::logger>("terratet", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_formatter(std::make_unique<PrintableFormatter>());
    spdlog::set_default_logger(std::move(logger));
}

bool asks_for_help(const std::string& argument) {
    return argument == "--help" || argument == "-help" || argument == "-h";
}

int dispatch(const std::vector<std::string>& arguments, const Ranks& ranks) {
    if (arguments.empty()) {
        std::fputs(short_usage().c_str(), stderr);
        return exit_usage;
    }
    const std::string& name = arguments.front();
    if (name == "--version" || name == "-version") {
        return print(std::string("terratet ") + version + (Ranks::available() ? " with MPI" : "") + "\n");
    }
    if (name == "--json-usage" || name == "-json-usage") {
        return print(json_usage());
    }
    if (name == "--man" || name == "-man") {  // for the build, which installs the pages
        return print(arguments.size() > 1 ? man_page(find_command(arguments[1])) : man_page());
    }
    if (name == "help" || asks_for_help(name)) {
        return print(arguments.size() > 1 ? help_on(arguments[1]) : general_help());
    }
    const CommandEntry& entry = find_command(name);
    const std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
    if (std::any_of(rest.begin(), rest.end(), asks_for_help)) {
        return print(command_help(entry));
    }
    const auto command = entry.make();
    const auto given = parse_arguments(command->syntax(), rest);
    const bool quiet = std::any_of(given.begin(), given.end(), [](const Given& option) { return option.name == "q"; });
    spdlog::set_level(quiet ? spdlog::level::warn : spdlog::level::info);
    if (ranks.count() > 1 && !command->share_among(ranks) && !ranks.is_root()) {
        return exit_done;
    }
    command->open_sockets();
    stay_offline(arguments, ranks);
    return command->run(given);
}

/// Of several ranks only the first speaks, and only it tells the shell how it went.
int say(const RankOutcome& outcome) {
    const auto line = [&](int exit_code) {
        std::fprintf(stderr, "terratet: %s\n", printable(with_options(one_line(outcome.message))).c_str());
        return exit_code;
    };
    switch (outcome.kind) {
        case RankOutcome::Kind::done:
            return exit_done;
        case RankOutcome::Kind::stopped:
            return tell_interrupted() ? line(exit_failed) : exit_failed;
        case RankOutcome::Kind::usage:
            return line(exit_usage);
        case RankOutcome::Kind::input:
            return line(exit_input);
        default:
            return line(exit_failed);
    }
}

RankOutcome run(const std::vector<std::string>& arguments, const Ranks& ranks, int& exit_code) {
    using Kind = RankOutcome::Kind;
    try {
        start_log();
        if (!ranks.is_root()) {
            fall_silent();
        }
        watch_for_interrupts();
        take_size_limits_as_errors();
        exit_code = dispatch(arguments, ranks);
        return {};
    } catch (const UsageError& error) {
        return {Kind::usage, error.what()};
    } catch (const InputError& error) {
        return {Kind::input, error.what()};
    } catch (const Cancelled&) {
        return {Kind::stopped, "interrupted; nothing was written"};
    } catch (const Error& error) {
        return {Kind::failed, error.what()};
    } catch (const std::bad_alloc&) {
        return {Kind::failed, out_of_memory};
    } catch (const std::length_error&) {  // a list longer than there can be
        return {Kind::failed, out_of_memory};
    } catch (const std::exception& error) {
        return {Kind::failed, std::string("something failed that should not (") + error.what() +
                                  "); please report it, with the command and its inputs"};
    }
}

}  // namespace

int run_terratet(const std::vector<std::string>& arguments) {
    const Ranks ranks;
    int exit_code = exit_done;
    const RankOutcome own = run(arguments, ranks, exit_code);
    if (!ranks.is_root()) {
        ranks.finish(own);
        return exit_done;
    }
    if (own.kind != RankOutcome::Kind::done) {  // at once: the others may take a while to notice
        exit_code = say(own);
        ranks.finish(own);
        return exit_code;
    }
    const RankOutcome all = ranks.finish(own);
    return all.kind == RankOutcome::Kind::done ? exit_code : say(all);
}

}  // namespace terratet::tools
