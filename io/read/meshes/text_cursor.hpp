// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Lines and words of a text in memory.

#include <cstdint>
#include <optional>
#include <string_view>

#include "io/base/text_lines.hpp"

namespace terratet {

/// LF, CRLF and CR end lines.
class TextCursor {
  public:
    explicit TextCursor(std::string_view text) : rest_(text) {}

    /// The next line, without blanks at its ends; false at the end.
    bool next(std::string_view& line) {
        if (rest_.empty()) {
            return false;
        }
        const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
        line = trimmed(rest_.substr(0, end));
        const bool crlf = end + 1 < rest_.size() && rest_[end] == '\r' && rest_[end + 1] == '\n';
        rest_.remove_prefix(std::min(end + (crlf ? 2 : 1), rest_.size()));
        ++number_;
        return true;
    }

    /// The next word of the text, across lines, comments (# to the line's end) left out; empty at the end.
    std::string_view word() {
        while (words_.empty() || words_.front() == '#') {
            if (!next(words_)) {
                return {};
            }
        }
        const std::string_view found = next_word(words_);
        words_ = trimmed(words_);
        return found;
    }

    /// The next word as a number; nullopt when it is none, or at the end.
    template <typename Number>
    std::optional<Number> number() {
        return whole_number<Number>(word());
    }

    [[nodiscard]] std::int64_t line() const { return number_; }  ///< of the line last returned, from 1
    [[nodiscard]] std::string_view rest() const { return rest_; }

  private:
    std::string_view rest_;
    std::string_view words_;
    std::int64_t number_ = 0;
};

}  // namespace terratet
