// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Rejected records of one file, with a limit: a gigabyte of junk must not become ten of complaints.

#include <cstdint>
#include <string>
#include <utility>

#include "tess/diagnostics.hpp"

namespace terratet {

/// Adds to the diagnostics until `limit`; what comes after is counted and told in one line at the end of the scope.
class Rejections {
  public:
    Rejections(Diagnostics& diagnostics, std::string file) : diagnostics_(diagnostics), file_(std::move(file)) {}
    ~Rejections() {
        if (count_ > limit) {
            diagnostics_.reject(file_, 0, std::to_string(count_ - limit) + " further records were rejected likewise");
        }
    }
    Rejections(const Rejections&) = delete;
    Rejections& operator=(const Rejections&) = delete;

    /// The first of them, for the message when nothing usable is left: " (line 3: …)", or empty.
    [[nodiscard]] const std::string& first() const { return first_; }

    /// `reason` is called only when it will be kept.
    template <typename Reason>
    void add(std::int64_t line, const Reason& reason) {
        if (++count_ <= limit) {
            std::string text = reason();
            if (count_ == 1) {
                first_ = " (" + (line > 0 ? "line or record " + std::to_string(line) + ": " : "") + text + ")";
            }
            diagnostics_.reject(file_, line, std::move(text));
        }
    }

  private:
    static constexpr std::int64_t limit = 1000;
    Diagnostics& diagnostics_;
    std::string file_;
    std::string first_;
    std::int64_t count_ = 0;
};

}  // namespace terratet
