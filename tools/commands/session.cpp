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

int dispatch(const std::vector<std::string>& arguments) {
    if (arguments.empty()) {
        std::fputs(short_usage().c_str(), stderr);
        return exit_usage;
    }
    const std::string& name = arguments.front();
    if (name == "--version" || name == "-version") {
        return print(std::string("terratet ") + version + "\n");
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
    command->open_sockets();
    stay_offline(arguments);
    return command->run(given);
}

int fail(int exit_code, const char* what) {
    std::fprintf(stderr, "terratet: %s\n", printable(with_options(one_line(what))).c_str());
    return exit_code;
}

}  // namespace

int run_terratet(const std::vector<std::string>& arguments) {
    try {
        start_log();
        watch_for_interrupts();
        take_size_limits_as_errors();
        return dispatch(arguments);
    } catch (const UsageError& error) {
        return fail(exit_usage, error.what());
    } catch (const InputError& error) {
        return fail(exit_input, error.what());
    } catch (const Cancelled&) {
        return tell_interrupted() ? fail(exit_failed, "interrupted; nothing was written") : exit_failed;
    } catch (const Error& error) {
        return fail(exit_failed, error.what());
    } catch (const std::bad_alloc&) {
        return fail(exit_failed, out_of_memory);
    } catch (const std::length_error&) {  // a list longer than there can be
        return fail(exit_failed, out_of_memory);
    } catch (const std::exception& error) {
        return fail(exit_failed, (std::string("something failed that should not (") + error.what() +
                                  "); please report it, with the command and its inputs")
                                     .c_str());
    }
}

}  // namespace terratet::tools
