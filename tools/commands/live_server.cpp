// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/commands/live_server.hpp"

#include <httplib.h>
#include <sys/random.h>

#include <array>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <list>

#include "tess/error.hpp"
#include "tools/run/process.hpp"

namespace terratet::tools {
namespace {

std::string random_token() {
    std::array<unsigned char, 16> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw Error("this system gives no random numbers");
    }
    std::string token;
    for (const unsigned char byte : bytes) {
        token += "0123456789abcdef"[byte >> 4];
        token += "0123456789abcdef"[byte & 15];
    }
    return token;
}

/// Those who follow the changes; each gets every event from its subscription on.
class Subscribers {
  public:
    using Queue = std::deque<std::string>;
    using Place = std::list<Queue>::iterator;

    Place add() {
        const std::lock_guard lock(mutex_);
        queues_.emplace_front();
        return queues_.begin();
    }
    void remove(Place place) {
        const std::lock_guard lock(mutex_);
        queues_.erase(place);
    }
    [[nodiscard]] bool any() {
        const std::lock_guard lock(mutex_);
        return !queues_.empty();
    }
    void send(const std::string& event) {
        const std::lock_guard lock(mutex_);
        for (Queue& queue : queues_) {
            queue.push_back(event);
        }
        arrived_.notify_all();
    }
    /// The next event, or nothing within a while.
    std::string next(Place place) {
        std::unique_lock lock(mutex_);
        arrived_.wait_for(lock, std::chrono::seconds(5), [&] { return !place->empty(); });
        if (place->empty()) {
            return {};
        }
        std::string event = std::move(place->front());
        place->pop_front();
        return event;
    }

  private:
    std::mutex mutex_;
    std::condition_variable arrived_;
    std::list<Queue> queues_;
};

/// A page of another site can name this server in a request, but not choose these headers.
bool is_own(const httplib::Request& request, const std::string& authority, const std::string& local_name) {
    const std::string host = request.get_header_value("Host");
    if (host != authority && host != local_name) {
        return false;
    }
    if (!request.has_header("Origin")) {
        return true;
    }
    const std::string origin = request.get_header_value("Origin");
    return origin == "http://" + authority || origin == "http://" + local_name;
}

}  // namespace

struct LiveServer::Impl {
    httplib::Server server;
    int port = 0;
};

LiveServer::LiveServer(int port) : impl_(std::make_unique<Impl>()) {
    httplib::Server& server = impl_->server;
    impl_->port = port == 0 ? server.bind_to_any_port("127.0.0.1") : server.bind_to_port("127.0.0.1", port) ? port : -1;
    if (impl_->port <= 0) {
        throw UsageError("--http " + std::to_string(port) + ": the port cannot be used; 0 takes any that is free");
    }
}

LiveServer::~LiveServer() = default;

void LiveServer::serve(LiveProtocol& protocol, ModelSession& session) {
    httplib::Server& server = impl_->server;
    const int bound = impl_->port;
    server.set_payload_max_length(64U << 20U);
    server.set_tcp_nodelay(true);
    Subscribers subscribers;
    session.on_change = [&](const SessionChange& change) {
        if (subscribers.any()) {
            subscribers.send("event: change\ndata: " + event_json(change).dump() + "\n\n");
        }
    };
    const std::string authority = "127.0.0.1:" + std::to_string(bound);
    const std::string local_name = "localhost:" + std::to_string(bound);
    const std::string root = "/" + random_token() + "/";
    server.set_pre_routing_handler([&](const httplib::Request& request, httplib::Response& response) {
        if (!is_own(request, authority, local_name)) {
            response.status = 403;
            return httplib::Server::HandlerResponse::Handled;
        }
        response.set_header("Cache-Control", "no-store");
        response.set_header("X-Content-Type-Options", "nosniff");
        return httplib::Server::HandlerResponse::Unhandled;
    });
    server.Get(root, [&](const httplib::Request&, httplib::Response& response) {
        const nlohmann::ordered_json state{{"model", session.path()},
                                           {"vertices", session.snapshot()->model().vertices.size()}};
        response.set_content(state.dump() + "\n", "application/json");
    });
    server.Post(root, [&](const httplib::Request& request, httplib::Response& response) {
        response.set_content(protocol.answer(request.body).dump() + "\n", "application/json");
    });
    server.Get(root + "events", [&](const httplib::Request&, httplib::Response& response) {
        static_cast<void>(session.snapshot()->mesh());  // what the next change is compared with
        const auto place = subscribers.add();
        const auto first = std::make_shared<bool>(true);
        response.set_chunked_content_provider(
            "text/event-stream",
            [&, place, first](std::size_t, httplib::DataSink& sink) {
                const std::string event =
                    std::exchange(*first, false) ? std::string(": subscribed\n\n") : subscribers.next(place);
                const std::string sent = event.empty() ? ": still here\n\n" : event;
                return sink.write(sent.data(), sent.size());
            },
            [&, place](bool) { subscribers.remove(place); });
    });
    print(nlohmann::ordered_json{{"url", "http://" + authority + root}}.dump() + "\n");
    server.listen_after_bind();
}

}  // namespace terratet::tools
