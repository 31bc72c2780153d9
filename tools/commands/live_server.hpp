// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// A live session by HTTP, on this machine alone.
///
/// It listens on 127.0.0.1 only. The URL holds a token of 128 random bits, without which everything is 404. A request
/// whose Host is another than this server's (a name that somebody has let point here) or whose Origin is another's (a
/// page of some site, open in the user's browser) is 403.

#include <memory>
#include <string>

#include "tools/commands/live_protocol.hpp"

namespace terratet::tools {

/// Has its port from the start: the command opens no socket later on (tools/run/offline.hpp).
class LiveServer {
  public:
    /// Port 0: any that is free. Throws UsageError for a port that is taken.
    explicit LiveServer(int port);
    ~LiveServer();
    LiveServer(const LiveServer&) = delete;
    LiveServer& operator=(const LiveServer&) = delete;

    /// Until the program is interrupted. The URL is printed on standard output as {"url":
    /// "http://127.0.0.1:PORT/TOKEN/"}.
    void serve(LiveProtocol& protocol, ModelSession& session);

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet::tools
