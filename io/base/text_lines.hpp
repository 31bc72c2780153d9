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

/// Reads a file line by line with bounded memory. LF and CRLF end a line.
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

  private:
    bool fill();

    struct Closer {
        void operator()(void* file) const;
    };
    std::string path_;
    std::unique_ptr<void, Closer> file_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0;  ///< unread part of the buffer
    std::size_t end_ = 0;
    std::int64_t number_ = 0;
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
