// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/interrupt.hpp"

#include <csignal>

namespace terratet::tools {
namespace {

volatile std::sig_atomic_t asked_to_stop = 0;

extern "C" void remember_interrupt(int signal) {
    asked_to_stop = 1;
    std::signal(signal, SIG_DFL);
}

}  // namespace

void watch_for_interrupts() {
    std::signal(SIGINT, remember_interrupt);
    std::signal(SIGTERM, remember_interrupt);
}

bool interrupted() {
    return asked_to_stop != 0;
}

}  // namespace terratet::tools
