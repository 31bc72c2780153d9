// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Asking whether to go on (Poll, progress.hpp).

#include <cstddef>

#include "tess/progress.hpp"

namespace terratet {

inline void ask(const Poll& poll) {
    if (poll) {
        poll();
    }
}

/// Asks once in so many small steps. \pre The poll outlives it.
class PatientPoll {
  public:
    explicit PatientPoll(const Poll& poll) : poll_(poll) {}
    void operator()() {
        if (++steps_ % 512 == 0) {
            ask(poll_);
        }
    }

  private:
    const Poll& poll_;
    std::size_t steps_ = 0;
};

}  // namespace terratet
