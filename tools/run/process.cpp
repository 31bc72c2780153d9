// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/process.hpp"

#include <unistd.h>

#include <cstdio>

#include <tbb/global_control.h>

#include "interp/ranks/ranks.hpp"
#include "tess/error.hpp"
#include "tools/options/printable.hpp"

namespace terratet::tools {

int print(const std::string& data) {
    const bool seen = isatty(STDOUT_FILENO) == 1;
    write_to_standard_output(seen ? printable(data, true) : data);
    return exit_done;
}

void write_to_standard_output(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size() || std::fflush(stdout) != 0) {
        throw Error("standard output cannot be written to");
    }
}

void start_together(const Ranks* ranks) {
    if (ranks != nullptr) {
        static_cast<void>(ranks->broadcast("go"));
    }
}

void fall_silent() {
    for (std::FILE* stream : {stdout, stderr}) {
        if (std::freopen("/dev/null", "w", stream) == nullptr) {
            throw Error("/dev/null cannot be written to");
        }
    }
}

struct ThreadLimit::Control {
    tbb::global_control control;
};

ThreadLimit::ThreadLimit(std::uint64_t threads) {
    if (threads > 0) {
        control_ = std::make_unique<Control>(
            Control{tbb::global_control(tbb::global_control::max_allowed_parallelism, threads)});
    }
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace terratet::tools
