// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Records of a text, one by one, as views of its cells.

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

/// See read_csv_file for what is a cell. UTF-16 with its mark comes as UTF-8. Memory: a chunk and the longest record.
class CsvSplitter {
  public:
    /// Throws InputError when the file cannot be opened.
    explicit CsvSplitter(std::string path);

    /// The beginning of the file, up to a chunk, without byte-order mark.
    [[nodiscard]] std::string_view head() const { return {buffer_.data() + begin_, end_ - begin_}; }

    void set_separator(char separator);

    /// The next record that is no blank line; false at the end. Views hold until the next call. Throws InputError.
    bool next(std::vector<std::string_view>& cells);

    [[nodiscard]] std::int64_t line() const { return record_line_; }  ///< on which that record begins, from 1

  private:
    bool fill();
    /// Bytes just read behind `end_`, as text; how many there are then.
    std::size_t decode(std::size_t count);
    /// One record from `begin_` on; false when the buffer ends within it.
    bool split(std::vector<std::string_view>& cells);
    std::string_view quoted_cell(std::size_t& i, bool& complete);
    [[nodiscard]] bool ends_cell(char c) const { return kind_[static_cast<unsigned char>(c)] != 0; }
    [[noreturn]] void refuse(const std::string& what) const;

    struct Closer {
        void operator()(void* file) const;
    };
    std::string path_;
    std::unique_ptr<void, Closer> file_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    bool at_end_ = false;
    enum class Encoding : std::uint8_t { unknown, bytes, utf16_le, utf16_be };
    Encoding encoding_ = Encoding::unknown;
    std::vector<unsigned char> units_;  ///< UTF-16: bytes of a character that is not whole yet
    char separator_ = ',';
    unsigned char kind_[256] = {};  ///< 1: separator, 2: end of a line
    std::int64_t line_ = 1;
    std::int64_t record_line_ = 1;
    std::deque<std::string> unquoted_;  ///< cells with doubled quotation marks
};

}  // namespace terratet
