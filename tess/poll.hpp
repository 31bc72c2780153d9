// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Internal: what lets a long step be stopped that cannot tell how far it is.

#include <functional>

namespace terratet {

/// Asked by such a step at least every 0.2 s; throws Cancelled to stop it. May be empty.
using Poll = std::function<void()>;

inline void ask(const Poll& poll) {
    if (poll) {
        poll();
    }
}

}  // namespace terratet
