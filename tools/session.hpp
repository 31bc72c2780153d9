// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// One call of the program: from arguments to an exit code.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace terratet::tools {

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;  ///< while running
inline constexpr int exit_usage = 2;
inline constexpr int exit_input = 3;  ///< the input data cannot be used
inline constexpr int exit_unmet = 4;  ///< done, but criteria stay unmet and --strict is given

/// Runs the command that the arguments (without the program's name) ask for. Every error becomes one line on standard
/// error that begins with "terratet: ", and an exit code; nothing is thrown.
int run_terratet(const std::vector<std::string>& arguments);

/// Writes data to standard output and returns exit_done. Throws Error when it cannot. Where that is a terminal, what
/// would change it is shown instead (printable.hpp).
int print(const std::string& data);

inline constexpr const char* out_of_memory = "out of memory; a larger --lmin or --voxel-size needs less";

class Stopwatch {
  public:
    [[nodiscard]] double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point begin_ = Clock::now();
};

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
