// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// The pairs of group code and value that a DXF consists of, in text or in binary.

#include <array>
#include <optional>
#include <string_view>

#include "io/read/meshes/byte_cursor.hpp"
#include "io/read/meshes/text_cursor.hpp"

namespace terratet {

/// Text: two lines a pair. Binary: a sentinel, then codes of two bytes (of one before AutoCAD's release 13) and values
/// whose kind follows from the code; numbers come as text that reads back as the same number.
class DxfPairs {
  public:
    explicit DxfPairs(std::string_view bytes);

    /// False at the end. The value holds until the next call. No code: it is no number, or one that nobody knows the
    /// values of; nothing can be read behind it. Throws InputError when a binary file is cut off.
    bool next(std::optional<int>& code, std::string_view& value);

    [[nodiscard]] std::int64_t line() const { return binary_ ? pairs_ : text_.line(); }  ///< or pair, from 1
    [[nodiscard]] std::string_view code_text() const { return code_text_; }

  private:
    bool next_binary(std::optional<int>& code, std::string_view& value);
    std::string_view string();
    template <typename Number>
    std::string_view number();

    std::string_view bytes_;
    TextCursor text_;
    ByteCursor cursor_;
    bool binary_ = false;
    bool wide_codes_ = true;
    std::int64_t pairs_ = 0;
    std::string_view code_text_;
    std::array<char, 32> digits_{};
};

}  // namespace terratet
