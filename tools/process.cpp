// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/process.hpp"

#include <unistd.h>

#include <cstdio>

#include <tbb/global_control.h>

#include "tess/error.hpp"
#include "tools/printable.hpp"

namespace terratet::tools {

int print(const std::string& data) {
    const bool seen = isatty(STDOUT_FILENO) == 1;
    const std::string text = seen ? printable(data, true) : data;
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        throw Error("standard output cannot be written to");
    }
    return exit_done;
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
