// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Clocks for benchmarks on shared machines.

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace terratet::bench {

inline double wall_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of the calling thread: what one-thread figures are made of, so that other programs on the machine count less.
inline double cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Of all threads of the process.
inline double process_cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Median by the given clock of `repeats` calls, in seconds.
template <typename Work>
double median_seconds(int repeats, double (*clock)(), Work work) {
    std::vector<double> seconds;
    for (int i = 0; i < repeats; ++i) {
        const double start = clock();
        work();
        seconds.push_back(clock() - start);
    }
    std::sort(seconds.begin(), seconds.end());
    return seconds[seconds.size() / 2];
}

}  // namespace terratet::bench
