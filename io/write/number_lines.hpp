// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Lines of numbers and words for the formats of simulators.

#include <string>

#include "io/base/csv_text.hpp"
#include "io/base/output_file.hpp"

namespace terratet {

/// Text as it grows, in numbers of all digits.
class NumberLines {
  public:
    explicit NumberLines(OutputFile& file) : file_(file) {}
    template <class... Values>
    void line(const Values&... values) {
        bool first = true;
        ((append(values, first), first = false), ...);
        text_ += '\n';
        if (text_.size() > 1 << 20) {
            flush();
        }
    }
    void flush() {
        file_.write(text_);
        text_.clear();
    }

  private:
    template <class Value>
    void append(const Value& value, bool first) {
        text_ += first ? "" : " ";
        if constexpr (std::is_arithmetic_v<Value>) {
            append_csv_number(text_, value);
        } else {
            text_ += value;
        }
    }
    OutputFile& file_;
    std::string text_;
};

}  // namespace terratet
