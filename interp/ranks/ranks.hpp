// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Processes that work at one command together, started by mpirun (TERRATET_MPI): rank 0 reads standard input, writes
/// and speaks, the others compute for it. Without MPI, or without mpirun, rank 0 is alone. No type of MPI shows.

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

/// What a rank came to; of errors the kinds of tess/error.hpp.
struct RankOutcome {
    enum class Kind : char { done, stopped, failed, usage, input };
    Kind kind = Kind::done;
    std::string message{};
};

/// Messages are bytes of any length, and arrive in the order in which they were sent. One call at a time, from any
/// thread. What waits sleeps in between, so that more ranks than cores do not disturb each other.
class Ranks {
  public:
    /// Joins the others, if there are any; once in a process, before it makes threads.
    Ranks();
    ~Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;

    /// Made with MPI?
    [[nodiscard]] static bool available();

    [[nodiscard]] int rank() const;
    [[nodiscard]] int count() const;
    [[nodiscard]] bool is_root() const { return rank() == 0; }

    /// To rank 0. Returns before the message has arrived, as long as few are on their way. \pre not rank 0
    void send(std::string bytes) const;
    /// At rank 0, of another. Throws what ended that rank.
    [[nodiscard]] std::string receive(int from) const;
    /// Rank 0's bytes, at every rank. In all that waits for rank 0, Cancelled is thrown when that has given up.
    [[nodiscard]] std::string broadcast(std::string bytes = {}) const;
    /// Everybody's bytes, at every rank.
    [[nodiscard]] std::vector<std::string> exchange(std::string bytes) const;

    /// The end, once at every rank, however it came: nobody waits for anybody afterwards, and messages that nobody
    /// wanted are dropped. At rank 0 the outcome of all: its own if that is an error, else that of the first rank whose
    /// is.
    RankOutcome finish(RankOutcome own) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace terratet
