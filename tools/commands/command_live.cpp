// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <limits>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "tess/error.hpp"
#include "tools/commands/live_protocol.hpp"
#include "tools/commands/live_server.hpp"
#include "tools/options/command.hpp"
#include "tools/options/run_options.hpp"
#include "tools/run/open_model.hpp"
#include "tools/run/process.hpp"

namespace terratet::tools {
namespace {

constexpr auto no_port = std::numeric_limits<std::uint64_t>::max();

/// Lines from standard input, answered in order on standard output.
void answer_lines(LiveProtocol& protocol, ModelSession& session) {
    bool subscribed = false;
    std::vector<std::string> events;
    session.on_change = [&](const SessionChange& change) {
        if (subscribed) {
            events.push_back(event_json(change).dump());
        }
    };
    for (std::string line; std::getline(std::cin, line);) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) {
            continue;
        }
        const auto request = nlohmann::ordered_json::parse(line, nullptr, false);
        nlohmann::ordered_json answer;
        if (request.is_object() && request.contains("subscribe")) {
            subscribed = request["subscribe"] == true;
            static_cast<void>(session.snapshot()->mesh());  // what the next change is compared with
            answer = {{"id", request.value("id", nlohmann::ordered_json(nullptr))},
                      {"ok", true},
                      {"result", {{"subscribed", subscribed}}},
                      {"seconds", 0.0}};
        } else {
            answer = protocol.answer(line);
        }
        std::string text = answer.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
        for (const std::string& event : events) {
            text += event + '\n';
        }
        events.clear();
        write_to_standard_output(text);
    }
}

class Live final : public Command {
  public:
    Syntax syntax() override {
        return {"live",
                {{"Options",
                  {{{"http"}, "PORT", "answer by HTTP on 127.0.0.1 instead; 0: any free port", &port_},
                   accept_edited_option(accept_edited_),
                   threads_option(threads_),
                   {{"q", "quiet"}, "", "nothing but errors on standard error", &quiet_}}}},
                {"MODEL.gpkg", 1, 1, &paths_}};
    }

    void open_sockets() override {
        if (port_ != no_port && port_ > 65535) {
            throw UsageError(fmt::format("--http: {} is no port", port_));
        }
        if (port_ != no_port) {
            server_ = std::make_unique<LiveServer>(static_cast<int>(port_));
        }
    }

    int run(const std::vector<Given>&) override {
        const ThreadLimit threads(threads_);
        ModelSession session(paths_.front(), accept_edited_);
        LiveProtocol protocol(session);
        if (server_) {
            server_->serve(protocol, session);
        } else {
            answer_lines(protocol, session);
        }
        return exit_done;
    }

  private:
    std::vector<std::string> paths_;
    std::unique_ptr<LiveServer> server_;
    std::uint64_t port_ = no_port;
    std::uint64_t threads_ = 0;
    bool accept_edited_ = false;
    bool quiet_ = false;
};

}  // namespace

CommandEntry live_command() {
    return {
        "live",
        "a model kept in memory, edited and asked by other programs",
        "MODEL.gpkg [--http PORT]",
        "Reads one JSON object a line from standard input and answers each by one on standard output, in order: "
        "{\"id\": 7, \"edit\": [\"move-borehole\", \"KR1\", \"--by\", \"5,0,0\"]}, or \"query\", \"section\", "
        "\"export\" with words as on the command line, \"script\" with a list of edits, \"subscribe\": true. Edits are "
        "stored as "
        "'terratet edit' stores them. With --http the same objects are posted to a URL that it prints.",
        {"terratet live site.gpkg --http 0", "echo '{\"id\": 1, \"query\": [\"region\"]}' | terratet live site.gpkg"},
        [] { return std::make_unique<Live>(); }};
}

}  // namespace terratet::tools
