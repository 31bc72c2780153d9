// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// What was wrong with the input, as values: a reader or a preparation step returns its result and adds here what it
/// skipped, changed or assumed, so that nothing is lost silently (guarantee F4 for faults).

#include <cstdint>
#include <string>
#include <vector>

namespace terratet {

/// One record that was skipped.
struct Rejected {
    std::string file;
    std::int64_t line = 0;  ///< 1-based line or record in the file; 0: the file as a whole
    std::string reason;
};

struct Diagnostics {
    std::vector<Rejected> rejected;  ///< records skipped, each with its reason
    std::vector<std::string> notes;  ///< assumptions made and things changed, for people to read

    void reject(std::string file, std::int64_t line, std::string reason) {
        rejected.push_back({std::move(file), line, std::move(reason)});
    }
    void note(std::string text) { notes.push_back(std::move(text)); }
};

}  // namespace terratet
