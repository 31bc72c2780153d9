// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
/// \file
/// Lines and words of text files, through GDAL's virtual file systems.

#include <charconv>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace terratet {

/// Reads a file line by line with bounded memory. LF, CRLF and a lone CR end a line. UTF-16, with byte order mark or
/// without, comes as UTF-8; a byte order mark is no part of the first line.
class LineReader {
  public:
    /// Throws InputError when the file cannot be opened.
    explicit LineReader(std::string path);
    ~LineReader();

    /// The next line without its end; false at the end of the file. The view holds until the next call. Throws
    /// InputError: a line is longer than 1 MiB, or reading fails.
    bool next(std::string_view& line);

    [[nodiscard]] std::int64_t number() const { return number_; }  ///< of the line last returned, from 1
    [[nodiscard]] bool terminated() const { return terminated_; }  ///< did that line end in LF?
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }   ///< read from the file so far

  private:
    enum class Encoding : std::uint8_t { unknown, bytes, utf16_le, utf16_be };
    bool fill();
    std::size_t decode_utf16(std::size_t begin, std::size_t count);
    void end_lines_at_lone_cr(std::size_t begin);

    struct Closer {
        void operator()(void* file) const;
    };
    std::string path_;
    std::unique_ptr<void, Closer> file_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0;  ///< unread part of the buffer
    std::size_t end_ = 0;
    std::int64_t number_ = 0;
    std::uint64_t bytes_ = 0;
    Encoding encoding_ = Encoding::unknown;
    std::vector<unsigned char> units_;  ///< UTF-16: bytes of a character that is not whole yet
    bool terminated_ = false;
    bool at_end_ = false;
};

/// Takes the next word off the front: up to a blank, or between double quotes (which are dropped). Empty at the end.
std::string_view next_word(std::string_view& text);

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The whole of the text as a number, whatever the locale.
template <typename Number>
std::optional<Number> whole_number(std::string_view text) {
    if (!text.empty() && text.front() == '+') {
        text.remove_prefix(1);
    }
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// A piece of a file for a message: at most 40 bytes, what is not printable ASCII replaced.
std::string excerpt(std::string_view text);

/// Names in files are UTF-8 or, in old ones, Windows-1252: UTF-8 either way, without NUL.
std::string to_utf8(std::string_view text);

}  // namespace terratet
