// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Peak memory of a piece of work, measured in a child process so that variants do not hide behind each other.

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <functional>

namespace terratet::bench {

/// Bytes by which `work` raised the peak resident set of a fresh child process; 0 when the child failed.
inline std::size_t peak_memory_of(const std::function<void()>& work) {
    int channel[2];
    if (pipe(channel) != 0) {
        return 0;
    }
    malloc_trim(0);  // else the child would work in what its parent has freed
    const pid_t child = fork();
    if (child == 0) {
        rusage before{};
        rusage after{};
        getrusage(RUSAGE_SELF, &before);
        work();
        getrusage(RUSAGE_SELF, &after);
        const std::size_t bytes = static_cast<std::size_t>(after.ru_maxrss - before.ru_maxrss) * 1024;
        _exit(::write(channel[1], &bytes, sizeof bytes) == sizeof bytes ? 0 : 1);
    }
    std::size_t bytes = 0;
    close(channel[1]);
    if (read(channel[0], &bytes, sizeof bytes) != sizeof bytes) {
        bytes = 0;
    }
    close(channel[0]);
    waitpid(child, nullptr, 0);
    return bytes;
}

}  // namespace terratet::bench
