// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What every command has to do with its process: standard output, time, threads.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "tools/options/exit_code.hpp"

namespace terratet {
class Ranks;
}

namespace terratet::tools {

/// Writes data to standard output and returns exit_done. Throws Error when it cannot. Where that is a terminal, what
/// would change it is shown instead (printable.hpp).
int print(const std::string& data);

/// Bytes as they are. Throws Error when they cannot be written.
void write_to_standard_output(std::string_view bytes);

inline constexpr const char* out_of_memory = "out of memory; a larger --lmin or --voxel-size needs less";

class Stopwatch {
  public:
    [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_ = Clock::now();
};

/// Waits until rank 0 has seen that its arguments and outputs are right. Null: nobody else is there.
void start_together(const Ranks* ranks);

/// What is printed from here on is not seen: of several ranks only 0 speaks.
void fall_silent();

/// As long as it lives, at most so many threads work; 0: as many as there are cores.
class ThreadLimit {
  public:
    explicit ThreadLimit(std::uint64_t threads);
    ~ThreadLimit();
    ThreadLimit(const ThreadLimit&) = delete;
    ThreadLimit& operator=(const ThreadLimit&) = delete;

  private:
    struct Control;
    std::unique_ptr<Control> control_;
};

}  // namespace terratet::tools
