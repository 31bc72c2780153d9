// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The protocol of a live session (docs/live.md): a JSON object a request, a JSON object an answer. How they travel,
/// as lines or by HTTP, is not its business.

#include <mutex>

#include "tools/commands/model_session.hpp"

namespace terratet::tools {

class LiveProtocol {
  public:
    explicit LiveProtocol(ModelSession& session) : session_(session) {}

    /// Never throws: an answer says what went wrong. Edits wait for each other; what only reads sees the newest state
    /// and waits for nobody. Safe from many threads.
    nlohmann::ordered_json answer(const std::string& request);

  private:
    nlohmann::ordered_json result_of(const nlohmann::ordered_json& request);

    ModelSession& session_;
    std::mutex editing_;
};

/// The vertices and cells that a change took out and put in, by ids.
nlohmann::ordered_json event_json(const SessionChange& change);

}  // namespace terratet::tools
