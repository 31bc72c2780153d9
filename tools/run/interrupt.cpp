// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/interrupt.hpp"

#include <pthread.h>
#include <unistd.h>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>
#include <thread>

#include "io/base/output_file.hpp"
#include "tools/options/exit_code.hpp"

namespace terratet::tools {
namespace {

using namespace std::chrono_literals;

constexpr auto grace = 150ms;  ///< for the operation to stop by itself and clean up

volatile std::sig_atomic_t asked_to_stop = 0;
std::array<int, 2> wake{-1, -1};  ///< a pipe: all that a signal handler may do is write a byte
std::atomic<bool> told = false;

extern "C" void remember_interrupt(int signal) {
    asked_to_stop = 1;
    std::signal(signal, SIG_DFL);
    [[maybe_unused]] const auto ignored = write(wake[1], "!", 1);
}

/// Waits for a signal and then ends the program when the operation has not done so: it may be within a library.
void end_when_deaf() {
    char byte = 0;
    while (read(wake[0], &byte, 1) < 0 && errno == EINTR) {
    }
    std::this_thread::sleep_for(grace);
    std::string done;
    for (const std::string& path : abandon_outputs()) {
        done += (done.empty() ? "" : ", ") + path;
    }
    if (tell_interrupted()) {
        std::fprintf(stderr, "terratet: interrupted; %s%s\n",
                     done.empty() ? "nothing was written" : "written before it: ", done.c_str());
    }
    _exit(exit_failed);
}

void start_watching() {
    if (pipe(wake.data()) != 0) {
        return;  // without one the operation alone decides
    }
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);  // signals are for the other threads
    std::thread(end_when_deaf).detach();
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace

void watch_for_interrupts() {
    [[maybe_unused]] static const bool once = (start_watching(), true);
    std::signal(SIGINT, remember_interrupt);
    std::signal(SIGTERM, remember_interrupt);
}

void take_size_limits_as_errors() {
    std::signal(SIGXFSZ, SIG_IGN);
}

bool interrupted() {
    return asked_to_stop != 0;
}

bool tell_interrupted() {
    return !told.exchange(true);
}

}  // namespace terratet::tools
