// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Progress and cancellation: one callback threaded through every operation that may take over a second.

#include <functional>
#include <string_view>

#include "tess/error.hpp"

namespace terratet {

/// Called now and then with the stage's name and the fraction of it that is done, 0…1 (never decreasing within a
/// stage). Returning false asks the operation to stop; it then throws Cancelled. Empty: no progress wanted.
/// Called from one thread at a time.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

/// Reports, and throws Cancelled when the callback says so.
inline void report_progress(const Progress& progress, std::string_view stage, double fraction) {
    if (progress && !progress(stage, fraction)) {
        throw Cancelled();
    }
}

/// What a step takes that cannot tell how far it is: called by it at least every 0.2 s; throws Cancelled to stop it.
/// May be empty.
using Poll = std::function<void()>;

}  // namespace terratet
